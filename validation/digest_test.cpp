#include "validation/digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "validation/file_hash.h"
#include "validation/measured.h"
#include "validation/metrics.h"
#include "validation/text_table.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr Window whole{0, 6};
const fs::path kleefsman = "data/kleefsman2005";

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

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

class DigestFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("sluice_digest_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  fs::path folder_;
};

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

struct KnownPressure {
  const char* sensor;
  double impulse_Pa_s;
  double peak_Pa;
  double peak_time_s;
};

/// Of the raw file, by the trapezoid rule with the value at 6 s interpolated; where a peak was not noted down, zero.
constexpr KnownPressure known_pressures[] = {{"P1", 13391.65, 11239.4, 0.4150},
                                             {"P2", 10961.15, 8127.5, 0.4260},
                                             {"P3", 9500.06, 6563.9, 0.4590},
                                             {"P4", 7088.09, 7202.6, 0.4550},
                                             {"P5", 2807.15, 0, 0},
                                             {"P6", 3029.65, 0, 0},
                                             {"P7", 3337.11, 0, 0},
                                             {"P8", 2933.23, 0, 0}};

TEST(KleefsmanDigest, KeepsTheImpulsesAndPeaksOfTheMeasurement) {
  const auto data = MeasuredData::load(kleefsman / "digest.csv");
  for (const auto& known : known_pressures) {
    const auto& series = data.series(known.sensor);
    EXPECT_EQ(series.unit, "Pa");
    EXPECT_NEAR(series.bin_s, 0.005, 1e-9);
    EXPECT_NEAR(*impulse(series, whole), known.impulse_Pa_s, 0.01) << known.sensor;
    if (known.peak_Pa == 0) continue;
    EXPECT_NEAR(peak(series, whole)->value, known.peak_Pa, 0.051) << known.sensor;
    EXPECT_NEAR(peak(series, whole)->time_s, known.peak_time_s, 0.0026) << known.sensor;
  }
}

TEST(KleefsmanDigest, KeepsArrivalAndSmoothedPeakAtP1) {
  const auto data = MeasuredData::load(kleefsman / "digest.csv");
  EXPECT_NEAR(*arrival_at_fraction_of_peak(data.series("P1"), whole), 0.3935, 0.001);
  EXPECT_NEAR(smoothed_peak(data.series("P1"), whole, 0.01)->value, 10100.8, 0.1);
}

TEST(KleefsmanDigest, NumbersTheWaveProbesAsTheDrawingDoes) {
  // The wave comes from the gate: H4 stands in the water, then H3 (x = 1.488 m), H2 and H1 (0.496 m) get wet.
  const auto data = MeasuredData::load(kleefsman / "digest.csv");
  const auto wet_at = [&](const char* probe) { return arrival_time(data.series(probe), whole, 0.01); };
  EXPECT_NEAR(*wet_at("H3"), 0.194, 0.005);
  EXPECT_NEAR(*wet_at("H1"), 0.918, 0.005);
  EXPECT_LT(*wet_at("H3"), *wet_at("H2"));
  EXPECT_LT(*wet_at("H2"), *wet_at("H1"));
  EXPECT_FALSE(wet_at("H4"));
  EXPECT_NEAR(data.series("H4").mean.front(), 0.549, 0.001);
}

class KleefsmanRaw : public DigestFolder {
 protected:
  void SetUp() override {
    raw_ = raw_data_folder() / "kleefsman2005/test_case_2_exp_data.dat";
    if (!fs::exists(raw_)) {
      GTEST_SKIP() << "the raw measurement is not part of the project and " << raw_.string()
                   << " is not there; set SLUICE_RAW_DATA to the folder of raw data";
    }
    DigestFolder::SetUp();
  }

  fs::path raw_;
};

TEST_F(KleefsmanRaw, RebuildsTheDigestByteForByte) {
  const auto source = load_digest_source(kleefsman / "source.toml");
  EXPECT_EQ(file_hash(raw_), source.files.front().hash);
  make_digest(source, {raw_}, folder_ / "digest.csv");
  EXPECT_TRUE(text_of(folder_ / "digest.csv") == text_of(kleefsman / "digest.csv"))
      << "data/kleefsman2005/digest.csv is not what source.toml and the raw file give; run \"sluice data digest\"";
}

TEST_F(KleefsmanRaw, TheMetricsOfTheUnbinnedSeriesAreTheKnownAnswers) {
  TextTableReader reader(raw_);
  reader.next_header_line();
  std::vector<std::string> names{"t"};
  for (int k = 1; k <= 12; ++k) names.push_back(std::to_string(k));
  const auto columns = reader.read_rows(names, ' ', 0);
  for (std::size_t k = 0; k < std::size(known_pressures); ++k) {
    const auto& known = known_pressures[k];
    const Series series{known.sensor, "Pa", columns[0], columns[k + 1]};
    EXPECT_NEAR(*impulse(series, whole), known.impulse_Pa_s, 0.005) << known.sensor;
    if (known.peak_Pa == 0) continue;
    EXPECT_NEAR(peak(series, whole)->value, known.peak_Pa, 0.051) << known.sensor;
    EXPECT_NEAR(peak(series, whole)->time_s, known.peak_time_s, 0.00051) << known.sensor;
  }
}

TEST_F(KleefsmanRaw, ComparedWithItsOwnDigestDeviatesByNothing) {
  TextTableReader reader(raw_);
  reader.next_header_line();
  const std::vector<std::string> names(13, "raw");
  const auto columns = reader.read_rows(names, ' ', 0);
  const auto data = MeasuredData::load(kleefsman / "digest.csv");
  const Comparison c = compare({"P1", "Pa", columns[0], columns[1]}, data.series("P1"), whole);
  EXPECT_NEAR(*c.arrival_s.difference(), 0, 0.001);
  EXPECT_NEAR(*c.peak.difference(), 0, 0.051);
  EXPECT_NEAR(*c.smoothed_peak.difference(), 0, 0.051);
  EXPECT_NEAR(*c.impulse.difference(), 0, 0.01);
  EXPECT_NEAR(*c.rmse, 0, 0.006);  // the digest's rounding
  EXPECT_NEAR(*c.lag_s, 0, 0.0005);
  EXPECT_GT(*c.correlation, 0.999);
  EXPECT_TRUE(c.remarks.empty());
}

constexpr const char* column_folder = "data/yeh_petroff";

TEST(ColumnDigest, KeepsTheKnownAnswersOfTheForce) {
  const MeasuredSeries force = MeasuredData::load(fs::path(column_folder) / "digest.csv").series("F");
  EXPECT_EQ(force.unit, "N");
  EXPECT_NEAR(force.bin_s, 0.025, 1e-9);
  EXPECT_NEAR(*impulse(force, {0.3, 1.3}), 13.3, 0.06);
  EXPECT_NEAR(*impulse(force, {1.4, 2.3}), -3.8, 0.05);
  const Window all{0, 2.3};
  EXPECT_NEAR(peak(force, all)->value, 33.3, 1e-9);
  EXPECT_NEAR(peak(force, all)->time_s, 0.405, 0.01);
  EXPECT_NEAR(smoothed_peak(force, all, 0.01)->value, 32.78, 0.01);
  EXPECT_NEAR(*arrival_time(force, all, 33.2 / 2), 0.364, 0.002);
  const auto lowest = std::min_element(force.minimum.begin(), force.minimum.end());
  EXPECT_NEAR(*lowest, -11.6, 0.1);
  EXPECT_NEAR(force.t_s[static_cast<std::size_t>(lowest - force.minimum.begin())], 1.57, 0.0126);
}

TEST(ColumnDigest, KeepsTheBandOfTheForce) {
  const MeasuredSeries force = MeasuredData::load(fs::path(column_folder) / "digest.csv").series("F");
  std::vector<double> widths;
  for (std::size_t k = 0; k < force.t_s.size(); ++k)
    if (force.t_s[k] > 0.5 && force.has_points(k)) widths.push_back(force.maximum[k] - force.minimum[k]);
  std::sort(widths.begin(), widths.end());
  EXPECT_NEAR(widths[widths.size() / 2], 1.4, 0.05);
  EXPECT_NEAR(widths.back(), 8.2, 0.1);
  EXPECT_EQ(std::count(force.points.begin(), force.points.end(), 0), 0) << "no bin is empty";
}

TEST(ColumnDigest, KeepsTheVelocityAndItsGap) {
  const MeasuredSeries u = MeasuredData::load(fs::path(column_folder) / "velocity.csv").series("U");
  EXPECT_EQ(u.unit, "m_s");
  EXPECT_NEAR(u.maximum.front(), 2.211, 1e-9);
  EXPECT_EQ(std::count(u.points.begin(), u.points.end(), 0), 4) << "nothing between 0.65 and 0.85 s";
}

/// Every digest of a data folder is what its description and the raw files give.
TEST_F(DigestFolder, TheColumnsDigestsAreRebuiltByteForByte) {
  for (const DigestPlan& plan : digest_plans(column_folder)) {
    const DigestSource source = load_digest_source(plan.description);
    std::vector<fs::path> raw;
    for (const RawFile& file : source.files) raw.push_back(raw_data_folder() / file.file);
    if (!fs::exists(raw.front())) {
      GTEST_SKIP() << "the raw measurement is not part of the project and " << raw.front().string()
                   << " is not there; set SLUICE_RAW_DATA to the folder of raw data";
    }
    make_digest(source, raw, folder_ / "digest.csv");
    EXPECT_TRUE(text_of(folder_ / "digest.csv") == text_of(plan.digest))
        << plan.digest << " is not what its description and the raw files give; run \"sluice data digest\"";
  }
}

}  // namespace
}  // namespace sluice
