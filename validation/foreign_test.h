// Foreign files as tests write them, and the map that reads them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "validation/foreign.h"

namespace sluice::foreign_test {

/// In a directory of its own, gone when it ends.
class ForeignTest : public testing::Test {
 protected:
  ForeignTest() {
    directory = std::filesystem::temp_directory_path() /
                (std::string("sluice-foreign-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
  }
  ~ForeignTest() override { std::filesystem::remove_all(directory); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  ProbeTable read(const std::string& files) const {
    write("m.toml", "case = \"kleefsman\"\nsolver = \"other\"\nl0_m = 0.02\n" + files);
    return read_foreign(load_foreign_map(directory / "m.toml"));
  }
  std::string refusal(const std::string& files) const {
    try {
      read(files);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path directory;
};

inline constexpr const char* plain = R"([[files]]
file = "a.csv"
time = { column = "time_s", unit = "s" }
columns = [ { sensor = "P1", column = "P1_Pa", unit = "Pa" }, { sensor = "H2", column = "H2_m", unit = "m" } ]
)";

/// A map's entry for a file of times `t` and one column.
inline std::string mapped(const std::string& file, const std::string& time_unit, const std::string& sensor,
                          const std::string& column, const std::string& unit) {
  return "[[files]]\nfile = \"" + file + "\"\ntime = { column = \"t\", unit = \"" + time_unit +
         "\" }\ncolumns = [ { sensor = \"" + sensor + "\", column = \"" + column + "\", unit = \"" + unit + "\" } ]\n";
}

}  // namespace sluice::foreign_test
