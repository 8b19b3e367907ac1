// The digests that the project commits: they keep the known answers of the measurements, and where the raw files are
// there, they are rebuilt and compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "validation/digest.h"
#include "validation/digest_folder.h"
#include "validation/file_hash.h"
#include "validation/measured.h"
#include "validation/metrics.h"
#include "validation/text_table.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr Window whole{0, 6};
const fs::path kleefsman = "data/kleefsman2005";

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
