#include "validation/computed_hash.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "validation/case.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

/// Of a case that this project has, with its first `from` replaced.
Case changed_case(const std::string& name, const std::string& from, const std::string& to) {
  const std::filesystem::path file = case_directory() / (name + ".toml");
  std::string text = read_text(file, "");
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return parse_case(text.replace(at, from.size(), to), file.string());
}

TEST(ComputedHash, WordsBandsAndMeasurementsAreNoInputs) {
  const Case column = load_case("column");
  for (const auto& [from, to] : Changes{
           {"# The dam break", "# A remark.\n# The dam break"},
           {"title = \"Dam", "title = \"The dam"},
           {"reference = \"Yeh", "reference = \"As shown by Yeh"},
           {"The transducer, its filter", "The transducer, its range, its filter"},
           {"window_s = [0.0, 2.3]", "window_s = [0.0, 2.2]"},
           {"measured = \"data/yeh_petroff/digest.csv\"", "measured = \"another.csv\""},
           {"measured_is_band = true", "measured_is_band = false"},
           {"impulses_s = [[0.3, 1.3], [1.4, 2.3]]", "impulses_s = [[0.3, 1.3]]"},
           {"measured_in = \"data/yeh_petroff/velocity.csv\"", "measured_in = \"another.csv\""},
           {"measured_shift_s = 0.26", "measured_shift_s = 0.25"},
           {"window_s = [0.31, 1.56]", "window_s = [0.31, 1.5]"},
           {"{ name = \"fine\", l0_m = 0.0075", "{ name = \"fine\", l0_m = 0.007"},
           {"lower = -0.19", "lower = -0.2"},
           {"density_kg_m3 = 1000.0", "density_kg_m3   =  1000"},
       }) {
    const Case changed = changed_case("column", from, to);
    EXPECT_NE(changed.hash, column.hash) << from;
    EXPECT_EQ(changed.computed_hash, column.computed_hash) << from;
  }
  const Case kleefsman = changed_case("kleefsman", "number = 4, sensor", "number = 5, sensor");
  EXPECT_EQ(kleefsman.computed_hash, load_case("kleefsman").computed_hash);
}

TEST(ComputedHash, AllElseIsAnInput) {
  const Case column = load_case("column");
  for (const auto& [from, to] : Changes{
           {"position_m = [0.754,", "position_m = [0.755,"},
           {"name = \"U\"", "name = \"V\""},
           {"direction = [1, 0, 0]", "direction = [0, 1, 0]"},
           {"gravity_m_s2 = [0.0, 0.0, -9.81]", "gravity_m_s2 = [0.0, 0.0, -9.8]"},
           {"density_kg_m3 = 1000.0", "density_kg_m3 = 998.0"},
           {"t_end_s = 2.5", "t_end_s = 2.4"},
           {"output_rate_Hz = 1000.0", "output_rate_Hz = 500.0"},
           {"snapshot_times_s = [0.35,", "snapshot_times_s = [0.36,"},
           {"upper_m = [1.60, 0.61, 0.75]", "upper_m = [1.61, 0.61, 0.75]"},
           {"velocity_m_s = [0.0, 0.0, 0.6]", "velocity_m_s = [0.0, 0.0, 0.7]"},
           {"delta = 0.1", "delta = 0.05"},
           {"parameters = { wall_friction = 0.0 }", "parameters = { wall_friction = 0.1 }"},
           {"pressure_model = \"wall\"", "pressure_model = \"kernel\""},
           {"layers = 3", "layers = 4"},
       })
    EXPECT_NE(changed_case("column", from, to).computed_hash, column.computed_hash) << from;
}

TEST(ComputedHash, WhereItIsNotToldTheBytesCount) {
  const Case c = load_case("kleefsman");
  const Case commented = changed_case("kleefsman", "name = ", "# A remark.\nname = ");
  EXPECT_TRUE(has_inputs_of(commented, c.computed_hash, c.hash));
  EXPECT_FALSE(has_inputs_of(commented, "", c.hash));
  EXPECT_TRUE(has_inputs_of(c, "", c.hash));
  EXPECT_TRUE(has_inputs_of(c, "of other rules than this program's", c.hash)) << "the same file";
  EXPECT_FALSE(has_inputs_of(c, "another", "another"));
}

}  // namespace
}  // namespace sluice
