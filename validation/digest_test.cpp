#include "validation/digest.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/digest_folder.h"
#include "validation/file_hash.h"
#include "validation/measured.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// What a call complains of; "no complaint" if nothing.
template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no complaint";
}

constexpr const char* small_source = R"(raw_file = "raw.dat"
header_lines = 1
header = "t a b"
separator = "blank"
column_count = 3
time_column = 1
time_scale = 0.001
bin_s = 0.01
smoothing_s = 0.004
[[columns]]
number = 3
raw_name = "b"
name = "P1"
unit = "Pa"
scale = 1000
mean_decimals = 3
extreme_decimals = 1
[[columns]]
number = 2
raw_name = "a"
name = "H1"
unit = "m"
mean_decimals = 4
extreme_decimals = 2
)";

/// 31 rows at whole milliseconds; a is the time in ms, b the time in ms / 1000, less 0.005.
std::string small_raw() {
  std::string text = "t a b\n";
  for (int i = 0; i <= 30; ++i)
    text += std::to_string(i) + " " + std::to_string(i) + "  " + std::to_string(i * 1e-3 - 0.005) + "\n";
  return text;
}

TEST_F(DigestFolder, BinsHoldMeanExtremesAndSmoothedMaximumUnderTheirNewNamesAndUnits) {
  write("source.toml", small_source);
  write("raw.dat", small_raw());
  const auto out = make_digests(folder_, folder_).front();
  EXPECT_EQ(text_of(out),
            "t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa,P1_max4ms_Pa,H1_mean_m,H1_min_m,H1_max_m,H1_max4ms_m\n"
            "0.005,0.000,-5.0,4.0,4.0,5.0000,0.00,9.00,9.00\n"
            "0.015,10.000,5.0,14.0,14.0,15.0000,10.00,19.00,19.00\n"
            "0.025,20.000,15.0,24.0,24.0,25.0000,20.00,29.00,29.00\n");
  const auto data = MeasuredData::load(out);
  EXPECT_EQ(data.names(), (std::vector<std::string>{"P1", "H1"}));
  EXPECT_NEAR(data.series("P1").bin_s, 0.01, 1e-12);
  EXPECT_NEAR(data.series("P1").smoothing_s, 0.004, 1e-12);
  EXPECT_EQ(data.series("H1").smoothed_maximum, (std::vector<double>{9, 19, 29}));
  EXPECT_EQ(data.hash(), file_hash(out));
}

TEST_F(DigestFolder, ABinThatIsHardlyCoveredIsLeftOut) {
  write("source.toml", small_source);
  std::string raw = small_raw();
  raw.resize(raw.rfind("\n30 ") + 1);  // the last bin now ends at 29 ms: nine tenths are there
  write("raw.dat", raw);
  EXPECT_EQ(MeasuredData::load(make_digests(folder_, folder_).front()).series("P1").t_s.size(), 3u);
  raw.resize(raw.rfind("\n29 ") + 1);
  write("raw.dat", raw);
  EXPECT_EQ(MeasuredData::load(make_digests(folder_, folder_).front()).series("P1").t_s.size(), 2u);
}

TEST_F(DigestFolder, ARawFileThatIsNotTheOneDescribedIsRefused) {
  const auto raw = (folder_ / "raw.dat").string();
  const auto digest = [&] { make_digests(folder_, folder_); };
  write("source.toml", small_source);
  EXPECT_EQ(complaint(digest).substr(0, raw.size() + 18), raw + ": no such raw file");
  write("raw.dat", "t b a\n0 1 2\n1 1 2\n");
  EXPECT_EQ(complaint(digest).substr(0, raw.size() + 44), raw + ":1: the header is not the one described (\"t ");
  write("raw.dat", "t a b\n0 1 2\n1 1\n");
  EXPECT_EQ(complaint(digest).substr(0, raw.size() + 36), raw + ":3: 2 fields where 3 columns are nam");
  write("raw.dat", "t a b\n0 1 2\n1 1 NaN\n");
  EXPECT_EQ(complaint(digest), raw + ":3: column 3 (b): NaN is not finite; leave the row out");
  write("source.toml", std::string("raw_hash = \"fnv1a64:0\"\n") + small_source);
  EXPECT_NE(complaint(digest).find("not fnv1a64:0 of the file described"), std::string::npos);
}

constexpr const char* scatter_source = R"(scatter = true
column_count = 2
time_column = 1
bin_s = 0.1
smoothing_s = 0.01
[[files]]
raw_file = "a.txt"
header_lines = 0
separator = "blank"
[[files]]
raw_file = "b.csv"
header_lines = 1
header = "t,f"
separator = "comma"
[[columns]]
number = 2
raw_name = "f"
name = "U"
unit = "m_s"
mean_decimals = 2
extreme_decimals = 1
)";

TEST_F(DigestFolder, PointsOfSeveralFilesArePutTogetherAndAGapIsBridgedAndCounted) {
  write("cloud.source.toml", scatter_source);
  write("a.txt", "3.9E-1\t\t4\r\n0.05\t1\r\n0.06\t\t3\r\n0.01\t\t2\r\n");  // not in order, a column that comes and goes
  write("b.csv", "t,f\n0.06,6\n0.31,7\n0.31,9\n");
  const auto out = make_digests(folder_, folder_).front();
  EXPECT_EQ(out, folder_ / "cloud.csv");
  EXPECT_EQ(text_of(out),
            "t_s,U_mean_m_s,U_min_m_s,U_max_m_s,U_max10ms_m_s,U_points_1\n"
            "0.05,3.00,1.0,6.0,4.1,4\n"
            "0.15,4.22,2.0,7.0,5.4,0\n"
            "0.25,5.44,3.0,8.0,6.6,0\n"
            "0.35,6.67,4.0,9.0,7.9,3\n");
  const MeasuredSeries series = MeasuredData::load(out).series("U");
  EXPECT_EQ(series.unit, "m_s");
  EXPECT_TRUE(series.has_points(0));
  EXPECT_FALSE(series.has_points(1));
}

TEST_F(DigestFolder, RecordingsAreNotPutTogether) {
  std::string text = scatter_source;
  write("source.toml", text.replace(text.find("true"), 4, "false"));
  const std::string message = complaint([&] { make_digests(folder_, folder_); });
  EXPECT_NE(message.find("source.toml:6: files: samples of several recordings"), std::string::npos) << message;
}

TEST_F(DigestFolder, AFolderWithoutADescriptionIsRefused) {
  EXPECT_NE(complaint([&] { make_digests(folder_, folder_); }).find("no source.toml"), std::string::npos);
}

TEST_F(DigestFolder, ADescriptionThatMakesNoSenseNamesItsLineAndKey) {
  const auto toml = (folder_ / "source.toml").string();
  const auto load = [&] { load_digest_source(toml); };
  std::string text = small_source;
  write("source.toml", text.replace(text.find("\"blank\""), 7, "\"pipe\""));
  EXPECT_EQ(complaint(load).substr(0, toml.size() + 30), toml + ":4: separator: \"pipe\" is not k");
  text = small_source;
  write("source.toml", text.replace(text.find("number = 3"), 10, "number = 4"));
  EXPECT_EQ(complaint(load).substr(0, toml.size() + 24), toml + ":11: columns[0].number: ");
  write("source.toml", std::string("colour = \"red\"\n") + small_source);
  EXPECT_EQ(complaint(load).substr(0, toml.size() + 11), toml + ":1: colour:");
  write("source.toml", "raw_file = \n");
  EXPECT_EQ(complaint(load).substr(0, toml.size() + 3), toml + ":1:");
  const auto with = [&](const std::string& from, const std::string& to) {
    text = small_source;
    write("source.toml", text.replace(text.find(from), from.size(), to));
    return complaint(load).substr(toml.size());
  };
  EXPECT_EQ(with("header_lines = 1", "header_lines = -1"), ":2: header_lines: is negative");
  EXPECT_EQ(with("column_count = 3", "column_count = -3"), ":5: column_count: must lie between 1 and 10000");
  EXPECT_EQ(with("smoothing_s = 0.004", "smoothing_s = 4e9"), ":9: smoothing_s: is 4000000000, must be 100 s at most");
  EXPECT_EQ(with("name = \"H1\"", "name = \"P1\""), ":21: columns[1].name: `P1` occurs twice");
  EXPECT_EQ(with("name = \"H1\"", "name = \"H\\u0000\"").substr(0, 22), ":21: columns[1].name: ");
  EXPECT_EQ(with("name = \"H1\"", "name = \"H,1\""),
            ":21: columns[1].name: has an underscore, separator, quote or blank (it becomes part of a column's name)");
}

TEST_F(DigestFolder, BinsThatMakeNoDigestAreRefused) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = small_source;
    write("source.toml", text.replace(text.find(from), from.size(), to));
    write("raw.dat", small_raw());
    return complaint([&] { make_digests(folder_, folder_); }).substr((folder_ / "raw.dat").string().size());
  };
  EXPECT_EQ(with("bin_s = 0.01", "bin_s = 1e-12"),
            ": times from 0 to 0.03 s make too many bins of 1e-12 s; are bin_s and the scale of time right?");
  EXPECT_EQ(with("bin_s = 0.01", "bin_s = 0.02"),
            ": b: fewer than two bins of 0.02 s are covered by samples; choose a narrower bin_s");
  EXPECT_EQ(with("bin_s = 0.01", "bin_s = 0.0005").substr(0, 38), ": b: no sample between 0.0005 and 0.00");
  write("source.toml", small_source);
  write("raw.dat", "t a b\n0 0 0\n5 0 1.7e305\n8 0 1.7e305\n13 0 1.7e305\n17 0 1.7e305\n20 0 0\n");
  EXPECT_NE(complaint([&] { make_digests(folder_, folder_); }).find(": b: its values are too large for means"),
            std::string::npos);
}

TEST(MeasuredData, AColumnWithoutAWidthIsNoSmoothedMaximum) {
  const auto data =
      MeasuredData::parse("t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa,P1_max..ms_Pa\n0,1,1,1,1\n1,1,1,1,1\n", "digest.csv");
  EXPECT_TRUE(data.series("P1").smoothed_maximum.empty());
}

TEST_F(DigestFolder, WhatIsNoDigestIsRefused) {
  const auto path = (folder_ / "digest.csv").string();
  const auto load = [&] { MeasuredData::load(path); };
  write("digest.csv", "t_s,P1_Pa\n0,1\n1,2\n");
  EXPECT_EQ(complaint(load), path + ":1: no column <name>_mean_<unit>; this is not a digest");
  write("digest.csv", "t_s,P1_mean_Pa,P1_min_Pa\n0,1,1\n1,2,2\n");
  EXPECT_EQ(complaint(load).substr(0, path.size() + 32), path + ":1: column P1_max_Pa is missing;");
  write("digest.csv", "t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa\n0,1,1,1\n1,1,1,1\n3,1,1,1\n");
  EXPECT_EQ(complaint(load).substr(0, path.size() + 30), path + ":3: t_s: the bin at 1 s is not");
  write("digest.csv", "t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa\n0,1,1,1\n1,1,2,1\n");
  EXPECT_EQ(complaint(load).substr(0, path.size() + 30), path + ":3: P1: minimum 2 over maximum");
  write("digest.csv", "t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa\n0,1,1,1\n1,1,1,1\n");
  EXPECT_EQ(complaint([&] { MeasuredData::load(path).series("P2"); }), path + ": no series P2; there are: P1");
}

}  // namespace
}  // namespace sluice
