// A result of another code with very many rows: read whole, in memory that stays in proportion.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "validation/foreign.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t rows = 10'000'000;

/// Its directory is gone when it ends, however it ends.
class ManyRows : public testing::Test {
 protected:
  ManyRows() {
    fs::remove_all(directory);
    fs::create_directories(directory);
  }
  ~ManyRows() override {
    std::error_code ignored;
    fs::remove_all(directory, ignored);
  }

  /// A row a tenth of a millisecond, its number behind it: "12.3456,123456".
  void write_rows() const {
    std::ofstream file(directory / "long.csv", std::ios::binary);
    file << "time_s,P1_Pa\n";
    std::string piece;
    for (std::int64_t i = 0; i < rows; ++i) {
      fmt::format_to(std::back_inserter(piece), "{}.{:04},{}\n", i / 10'000, i % 10'000, i);
      if (piece.size() < 1 << 20) continue;
      file << piece;
      piece.clear();
    }
    file << piece;
    file.close();
    ASSERT_TRUE(file) << "no room for the rows on the disk of " << directory;
  }

  fs::path directory = fs::temp_directory_path() / "sluice-foreign-rows";
};

std::int64_t greatest_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss);
}

TEST_F(ManyRows, TenMillionAreReadWithinTwentyFourBytesAValue) {
  ASSERT_NO_FATAL_FAILURE(write_rows());
  std::ofstream(directory / "long.toml") << R"(case = "kleefsman"
solver = "other"
l0_m = 0.02
[[files]]
file = "long.csv"
time = { column = "time_s", unit = "s" }
columns = [ { sensor = "P1", column = "P1_Pa", unit = "Pa" } ]
)";
  const std::int64_t before_bytes = greatest_memory_bytes();
  const ProbeTable table = read_foreign(load_foreign_map(directory / "long.toml"));
  const std::int64_t taken_bytes = greatest_memory_bytes() - before_bytes;
  ASSERT_EQ(table.rows(), static_cast<std::size_t>(rows));
  EXPECT_EQ(table.times_s().front(), 0.0);
  EXPECT_EQ(table.times_s().back(), 999.9999);
  EXPECT_EQ(table.values("P1_Pa").back(), static_cast<double>(rows - 1));
  constexpr std::int64_t values = 2 * rows;
  constexpr std::int64_t program_itself_bytes = 50'000'000;  // the case, buffers, what the allocator keeps
  EXPECT_LT(taken_bytes, 24 * values + program_itself_bytes);
}

}  // namespace
}  // namespace sluice
