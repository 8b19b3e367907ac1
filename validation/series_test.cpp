#include "validation/series.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "validation/file_hash.h"
#include "validation/text_table.h"

namespace sluice {
namespace {

class ProbesFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) / (std::string("sluice_series_") + test->name() + ".csv");
    std::filesystem::remove(path_);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  std::string text() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// What reading the text complains of, without the folder.
  std::string complaint(const std::string& text) const {
    write(text);
    try {
      read_probes(path_);
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(path_.string().size());
    }
    return "no complaint";
  }

  std::filesystem::path path_;
};

TEST(ColumnName, SplitsAtTheLastUnderscore) {
  EXPECT_EQ(split_column_name("P1_wall_Pa").name, "P1_wall");
  EXPECT_EQ(split_column_name("P1_wall_Pa").unit, "Pa");
  EXPECT_EQ(split_column_name("P1_kernel_support_1").unit, "1");
  EXPECT_EQ(split_column_name("pressure").name, "pressure");
  EXPECT_EQ(split_column_name("pressure").unit, "");
}

TEST(SplitFields, KeepsEmptyFieldsOfCommasAndNoneOfBlanks) {
  EXPECT_EQ(split_fields("a, b ,,c,", ','), (std::vector<std::string>{"a", "b", "", "c", ""}));
  EXPECT_EQ(split_fields("  a \t b  ", ' '), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(split_fields("", ',').empty());
}

TEST_F(ProbesFile, ReadsColumnsByName) {
  write("t_s,P1_wall_Pa,H1_m\n0,1.5,0.25\n0.001,-2e3,+0.5\n");
  const auto table = read_probes(path_);
  EXPECT_EQ(table.names(), (std::vector<std::string>{"P1_wall_Pa", "H1_m"}));
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_TRUE(table.has("H1_m"));
  EXPECT_FALSE(table.has("H1"));
  const auto series = table.column("P1_wall_Pa");
  EXPECT_EQ(series.name, "P1_wall");
  EXPECT_EQ(series.unit, "Pa");
  EXPECT_EQ(series.t_s, (std::vector<double>{0, 0.001}));
  EXPECT_EQ(series.value, (std::vector<double>{1.5, -2000}));
  EXPECT_EQ(table.values("H1_m"), (std::vector<double>{0.25, 0.5}));
}

TEST_F(ProbesFile, ReadsWhatOtherProgramsWrite) {
  write("\xEF\xBB\xBFt_s , P1_Pa\r\n 0 , 1\r\n1 , 2\r\n\r\n");
  EXPECT_EQ(read_probes(path_).values("P1_Pa"), (std::vector<double>{1, 2}));
  write("t_s,P1_Pa\n0,1\n1,2");  // no line end at the end
  EXPECT_EQ(read_probes(path_).values("P1_Pa"), (std::vector<double>{1, 2}));
}

TEST_F(ProbesFile, ARunThatHasJustStartedIsAnEmptyTable) {
  write("t_s,P1_Pa\n");
  const auto table = read_probes(path_);
  EXPECT_EQ(table.rows(), 0u);
  EXPECT_TRUE(table.has("P1_Pa"));
}

TEST_F(ProbesFile, AnUnknownColumnIsAnErrorThatListsTheColumns) {
  write("t_s,P1_Pa,H1_m\n0,1,2\n");
  const auto table = read_probes(path_);
  try {
    table.column("P2_Pa");
    FAIL() << "no error";
  } catch (const std::out_of_range& error) {
    EXPECT_EQ(std::string(error.what()), path_.string() + ": no column P2_Pa; there are: P1_Pa, H1_m");
  }
}

TEST_F(ProbesFile, ErrorsNameLineAndColumn) {
  EXPECT_EQ(complaint(""), ": the file is empty; it needs a header line");
  EXPECT_EQ(complaint("time_s,P1_Pa\n0,1\n"),
            ":1: the first column must be t_s, the time in seconds; rename or convert \"time_s\"");
  EXPECT_EQ(complaint("t_s,P1_Pa,P1_Pa\n"), ":1: column P1_Pa occurs twice; rename or delete one");
  EXPECT_EQ(complaint("t_s,,P1_Pa\n"), ":1: column 2 has no name; write <sensor>_<unit>");
  EXPECT_EQ(complaint("t_s,P1\x1b_Pa\n"), ":1: the name of column 2 holds a control character; rename it");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1\n1,x\n"),
            ":3: P1_Pa: \"x\" is not a number; write numbers with a decimal point, and leave nothing empty");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1\n1,2.5kPa\n").substr(0, 18), ":3: P1_Pa: \"2.5kPa");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,\n").substr(0, 13), ":2: P1_Pa: \"\"");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1\n1,nan\n"), ":3: P1_Pa: nan is not finite; leave the row out");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,-inf\n"), ":2: P1_Pa: -inf is not finite; leave the row out");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1e999\n"), ":2: P1_Pa: \"1e999\" does not fit a double");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1,2\n").substr(0, 41), ":2: 3 fields where 2 columns are named; i");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1\n0.00").substr(0, 41), ":3: 1 fields where 2 columns are named; a");
  EXPECT_EQ(complaint("t_s,P1_Pa\n0,1\n\n1,2\n"), ":4: a row after a blank line; delete blank lines between rows");
  EXPECT_EQ(complaint("t_s,P1_Pa\n1,1\n0.5,2\n"),
            ":3: t_s: 0.5 does not come after 1 of the row before; sort the rows by time and drop repeated ones");
  EXPECT_EQ(complaint("t_s,P1_Pa\n1,1\n1,2\n").substr(0, 28), ":3: t_s: 1 does not come aft");
}

TEST_F(ProbesFile, AMissingFileOrAFolderIsAnError) {
  EXPECT_THROW(read_probes(path_), std::runtime_error);
  EXPECT_THROW(read_probes(testing::TempDir()), std::runtime_error);
}

TEST(ProbeTable, RefusesColumnsThatDoNotFit) {
  EXPECT_THROW(ProbeTable("x", {"a"}, {0, 1}, {{1}}), std::invalid_argument);
  EXPECT_THROW(ProbeTable("x", {"a", "b"}, {0}, {{1}}), std::invalid_argument);
  EXPECT_THROW(ProbeTable("x", {"a", "a"}, {0}, {{1}, {1}}), std::invalid_argument);
}

TEST_F(ProbesFile, WhatIsWrittenIsReadBack) {
  const double third = 1.0 / 3;
  write_probes(path_, ProbeTable("", {"P1_Pa", "H1_m"}, {0, 1e-5, 6.00001234567}, {{0, -12345.678, third}, {1, 2, 3}}));
  const auto table = read_probes(path_);
  EXPECT_EQ(table.names(), (std::vector<std::string>{"P1_Pa", "H1_m"}));
  EXPECT_EQ(table.times_s(), (std::vector<double>{0, 1e-5, 6.00001234567}));
  EXPECT_NEAR(table.values("P1_Pa")[2], third, 1e-9);
  EXPECT_EQ(table.values("P1_Pa")[1], -12345.678);
}

TEST_F(ProbesFile, SinglePrecisionSurvivesExactly) {
  const float value = 11239.4375F + 1.0F / 1024;
  write_probes(path_, ProbeTable("", {"P1_Pa"}, {0}, {{value}}));
  EXPECT_EQ(static_cast<float>(read_probes(path_).values("P1_Pa")[0]), value);
}

TEST_F(ProbesFile, FlushedRowsCanBeReadWhileTheRunGoesOn) {
  ProbeWriter writer(path_, {"P1_Pa"});
  EXPECT_EQ(read_probes(path_).rows(), 0u);
  writer.append(0, std::vector<double>{1});
  writer.append(0.001, std::vector<double>{2});
  writer.flush();
  EXPECT_EQ(read_probes(path_).rows(), 2u);
  writer.append(0.002, std::vector<double>{3});
  writer.close();
  EXPECT_EQ(read_probes(path_).rows(), 3u);
  EXPECT_EQ(writer.rows(), 3);
  EXPECT_THROW(writer.append(0.003, std::vector<double>{4}), std::logic_error);
}

TEST_F(ProbesFile, TheDestructorFlushes) {
  { ProbeWriter(path_, {"P1_Pa"}).append(0, std::vector<double>{1}); }
  EXPECT_EQ(text(), "t_s,P1_Pa\n0,1\n");
}

TEST_F(ProbesFile, TheWriterRefusesWhatTheReaderWould) {
  ProbeWriter writer(path_, {"P1_Pa", "H1_m"});
  writer.append(1, std::vector<double>{1, 2});
  EXPECT_THROW(writer.append(2, std::vector<double>{1}), std::invalid_argument);
  EXPECT_THROW(writer.append(1, std::vector<double>{1, 2}), std::invalid_argument);
  try {
    writer.append(2, std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              path_.string() + ": H1_m is nan at t = 2 s: the simulation has diverged; rows up to then are kept");
  }
  writer.close();
  EXPECT_EQ(read_probes(path_).rows(), 1u);
}

TEST_F(ProbesFile, AFolderThatIsNotThereIsNamed) {
  try {
    ProbeWriter writer(path_ / "none" / "probes.csv", {"P1_Pa"});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("check that its folder exists"), std::string::npos);
  }
}

TEST(ProbeWriter, AFullDiskIsNamedWithItsRemedy) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  try {
    ProbeWriter writer("/dev/full", {"P1_Pa"});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("/dev/full: cannot be written (No space left on device); free space on that disk"))
        << text;
  }
}

/// While it lives, no file may grow over so many bytes; a write beyond fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(ProbesFile, ADiskThatFillsUpLeavesWholeRows) {
  ProbeWriter writer(path_, {"P1_Pa"});
  writer.append(0, std::vector<double>{1});
  writer.flush();
  {
    const FileSizeLimit limit(20);
    writer.append(1, std::vector<double>{123456789});
    EXPECT_THROW(writer.flush(), std::runtime_error);
  }
  EXPECT_EQ(text(), "t_s,P1_Pa\n0,1\n");
  EXPECT_EQ(read_probes(path_).rows(), 1u);
}

TEST_F(ProbesFile, RowsWaitForADiskThatIsFull) {
  ProbeWriter writer(path_, {"P1_Pa"});
  {
    const FileSizeLimit limit(20);
    writer.append(0, std::vector<double>{1});
    writer.append(1, std::vector<double>{123456789});
    EXPECT_THROW(writer.flush(), std::runtime_error);
    EXPECT_NE(writer.trouble().find("free space on that disk"), std::string::npos);
    writer.append(2, std::vector<double>{3});
  }
  writer.flush();
  EXPECT_EQ(writer.trouble(), "");
  EXPECT_EQ(text(), "t_s,P1_Pa\n0,1\n1,123456789\n2,3\n");
}

/// Whoever finds the disk full first, be it a checkpoint: from then on rows wait for as long as they may.
TEST_F(ProbesFile, RowsWaitFromTheFirstWriteThatFailed) {
  ProbeWriter writer(path_, {"P1_Pa"});
  const FileSizeLimit limit(20);
  writer.append(0, std::vector<double>{1});
  writer.append(1, std::vector<double>{123456789});
  EXPECT_THROW(writer.flush_to_disk(), std::runtime_error);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // until a flush is due
  EXPECT_NO_THROW(writer.append(2, std::vector<double>{3}));
  EXPECT_NE(writer.trouble(), "");
}

TEST_F(ProbesFile, RowsDoNotWaitForEver) {
  ProbeWriter writer(path_, {"P1_Pa"});
  writer.patience = {};
  const FileSizeLimit limit(20);
  const std::string before = text();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // until a flush is due
  EXPECT_THROW(writer.append(0, std::vector<double>{123456789}), std::runtime_error);
  EXPECT_EQ(text(), before) << "whole rows only";
}

TEST_F(ProbesFile, ManyRowsTakeNoLongerEach) {
  constexpr int rows = 300'000;
  {
    ProbeWriter writer(path_, {"P1_Pa", "H1_m"});
    for (int i = 0; i < rows; ++i) writer.append(1e-3 * i, std::vector<double>{1.0 * i, -1.0 * i});
  }
  const auto table = read_probes(path_);
  ASSERT_EQ(table.rows(), static_cast<std::size_t>(rows));
  EXPECT_EQ(table.values("H1_m").back(), 1.0 - rows);
}

TEST_F(ProbesFile, TheHashIsThatOfTheBytes) {
  // Known answers of the function's authors.
  EXPECT_EQ(fnv1a64(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fnv1a64("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fnv1a64("foobar"), 0x85944171f73967e8u);
  write("foobar");
  EXPECT_EQ(file_hash(path_), "fnv1a64:85944171f73967e8");
  EXPECT_THROW(file_hash(path_.string() + ".none"), std::runtime_error);
}

}  // namespace
}  // namespace sluice
