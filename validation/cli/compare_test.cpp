// `sluice compare` as its users meet it: another code's results, and bands of its own.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "validation/cli/program_test.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using program_test::Answer;
using program_test::contents;

class CompareCommand : public program_test::InDirectory {
 protected:
  CompareCommand() : InDirectory("sluice-compare") {}

  Answer sluice(const std::string& arguments) const {
    return command(fmt::format("{} {}", program_test::program_path("SLUICE_PROGRAM", "sluice"), arguments));
  }
};

/// Gauges of the water level as DualSPHysics writes them, dry at the end, and a map that takes their heights to be in
/// `unit`.
void write_gauge(const fs::path& directory, const std::string& unit) {
  std::ofstream(directory / "GaugesSWL_H4.csv")
      << "time [s];swlx [m];swly [m];swlz [m];pos0x [m];pos0y [m];pos0z [m]\n"
         "0;2.638;0.5;0.55;2.638;0.5;0\n0.05;2.638;0.5;0.549;2.638;0.5;0\n0.1;2.638;0.5;0.546;2.638;0.5;0\n"
         "0.15;2.638;0.5;NaN;2.638;0.5;0\n";
  std::ofstream(directory / "gauges.toml") << R"(case = "kleefsman"
solver = "DualSPHysics"
l0_m = 0.02
[[files]]
file = "GaugesSWL_H4.csv"
separator = ";"
skip_incomplete_rows = true
time = { column = "time [s]", unit = "s" }
columns = [ { sensor = "H4", column = "swlz [m]", unit = ")"
                                           << unit << "\" } ]\n";
}

TEST_F(CompareCommand, ReportsOnGaugesOfAnotherCode) {
  write_gauge(directory, "m");
  const fs::path out = directory / "report";
  const std::string command = fmt::format("compare {} --case kleefsman --no-figures --out {}",
                                          (directory / "gauges.toml").string(), out.string());
  const Answer answer = sluice(command);
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("index.html"));
  for (const char* page : {"index.html", "report.md"}) EXPECT_THAT(contents(out / page), HasSubstr("DualSPHysics"));
  const RunRecord record = read_run(out / "imported" / "gauges");
  EXPECT_EQ(record.probes.rows(), 3u);
  EXPECT_EQ(record.probes.values("H4_m").back(), 0.546);
  EXPECT_THAT(answer.err,
              AllOf(HasSubstr("sluice: warning: R1 ("), HasSubstr("covers 0.10 s of a window"),
                    HasSubstr("1 incomplete rows of its files were left out"), Not(HasSubstr("is its unit"))));
}

TEST_F(CompareCommand, WarnsOfUnitsThatAreOffByAThousand) {
  write_gauge(directory, "mm");
  const Answer answer =
      sluice(fmt::format("compare {0}/gauges.toml --no-figures --out {0}/report", directory.string()));
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.err, AllOf(HasSubstr("sluice: warning: R1 ("), HasSubstr("H4 peaks at"),
                                HasSubstr("times the measured value: is its unit m?")));
}

// A pressure of another code, flat at 1000 Pa over the whole window.
void write_flat_run(const fs::path& run) {
  fs::create_directories(run);
  std::ofstream(run / "run.json") << R"({ "case": "kleefsman", "solver": "mycode", "l0_m": 0.02 })";
  std::ofstream probes(run / "probes.csv");
  probes << "t_s,P1_Pa\n";
  for (int k = 0; k <= 6000; k += 2) probes << fmt::format("{},1000\n", 0.001 * k);
}

void write_bands(const fs::path& file, const std::string& solver, const std::string& band) {
  std::ofstream(file) << fmt::format(R"([[acceptance]]
solver = "{}"
rows = [ {{ metric = "impulse_deviation", sensor = "P1", {}, remark = "ours" }} ]
)",
                                     solver, band);
}

TEST_F(CompareCommand, HoldsAnotherCodeAgainstBandsOfItsOwn) {
  write_flat_run(directory / "mine");
  const fs::path bands = directory / "bands.toml";
  const std::string command =
      fmt::format("compare {0}/mine --bands {0}/bands.toml --no-figures --out {0}/report", directory.string());
  write_bands(bands, "mycode", "within = 0.9");
  Answer answer = sluice(command);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out,
              AllOf(HasSubstr("all bands hold"), HasSubstr("impulse_deviation P1"), HasSubstr("index.html")));
  EXPECT_THAT(contents(directory / "report" / "report.md"), HasSubstr("mycode (bands of "));
  write_bands(bands, "mycode", "lower = 0.9");
  answer = sluice(command);
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("FAIL"), HasSubstr("A BAND IS MISSED"), HasSubstr("index.html")));
  write_bands(bands, "another", "within = 0.9");
  answer = sluice(command);
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.out, HasSubstr("no row applies to any of these runs (it names solver another; these are mycode)"));
  std::ofstream(bands) << "[[acceptance]]\nsolver = \"mycode\"\nrows = [ { metric = \"impulse\", within = 1 } ]\n";
  answer = sluice(command);
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("bands.toml:3: "), HasSubstr("unknown metric `impulse`")));
  fs::remove(bands);
  EXPECT_THAT(sluice(command).err, HasSubstr("bands.toml: cannot be read"));
}

TEST_F(CompareCommand, RefusesAnotherCase) {
  write_gauge(directory, "m");
  const Answer answer =
      sluice(fmt::format("compare {0}/gauges.toml --case column --no-figures --out {0}/report", directory.string()));
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("is of the case kleefsman, not column"));
}

}  // namespace
}  // namespace sluice
