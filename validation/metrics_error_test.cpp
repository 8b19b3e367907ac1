#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "validation/metrics.h"
#include "validation/synthetic_curves.h"

namespace sluice {
namespace {

using synthetic::binned;
using synthetic::sampled_evenly;
using synthetic::sampled_unevenly;

constexpr Window whole{0, 6};
constexpr double pi = std::numbers::pi;

/// Two surges, the second broader: no symmetry that a lag could hide behind.
double surges(double t) {
  return 1000 * std::exp(-0.5 * std::pow((t - 1.2) / 0.05, 2)) + 400 * std::exp(-0.5 * std::pow((t - 3.5) / 0.4, 2));
}

Series with_noise(Series series, double standard_deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, standard_deviation);
  for (double& value : series.value) value += normal(random);
  return series;
}

TEST(Rmse, OfAConstantOffsetIsTheOffset) {
  const Series measured = sampled_evenly(surges, whole, 0.001);
  const Series offset = sampled_evenly([](double t) { return surges(t) - 25; }, whole, 0.001);
  EXPECT_NEAR(*rmse(offset, measured, whole), 25, 1e-9);
  EXPECT_NEAR(*rmse(measured, measured, whole), 0, 1e-12);
  EXPECT_NEAR(*rmse(offset, binned(surges, 0.005, 1200), whole), 25, 1e-3);
}

TEST(Rmse, OfASineDifferenceIsItsRootMeanSquareHoweverItIsSampled) {
  const auto zero = [](double) { return 0.0; };
  const auto sine = [](double t) { return 10 * std::sin(2 * pi * t); };
  const Series measured = sampled_evenly(zero, whole, 0.013);
  EXPECT_NEAR(*rmse(sampled_evenly(sine, whole, 0.001), measured, whole), 10 / std::sqrt(2), 1e-3);
  EXPECT_NEAR(*rmse(sampled_unevenly(sine, whole, 0.001), measured, whole), 10 / std::sqrt(2), 1e-3);
}

TEST(Rmse, IsExactForStraightPieces) {
  // Difference t over [0, 6]: mean square 12.
  const Series line = sampled_unevenly([](double t) { return t; }, whole, 0.5);
  const Series zero = sampled_unevenly([](double) { return 0.0; }, whole, 0.7);
  EXPECT_NEAR(*rmse(line, zero, whole), std::sqrt(12.0), 1e-12);
}

TEST(Rmse, CountsTimeNotSamples) {
  // The difference is 1 in the last second only, however many samples stand there.
  Series series = sampled_evenly([](double) { return 0.0; }, {0, 4.9999}, 0.5);
  for (int i = 0; i <= 1000; ++i) series.t_s.push_back(5 + 0.001 * i), series.value.push_back(1);
  const Series zero = sampled_evenly([](double) { return 0.0; }, whole, 0.5);
  EXPECT_NEAR(*rmse(series, zero, whole), std::sqrt(1.0 / 6), 1e-4);
}

TEST(Rmse, OfScaleAndNoiseIsKnown) {
  const Series measured = sampled_evenly(surges, whole, 0.001);
  const Series scaled = sampled_evenly([](double t) { return 1.1 * surges(t); }, whole, 0.001);
  const Series zero = sampled_evenly([](double) { return 0.0; }, whole, 0.001);
  EXPECT_NEAR(*rmse(scaled, measured, whole), 0.1 * *rmse(measured, zero, whole), 1e-9);
  // White noise of 30 between samples interpolated: mean square 2/3 of 30^2.
  EXPECT_NEAR(*rmse(with_noise(measured, 30), measured, whole), 30 * std::sqrt(2.0 / 3), 0.6);
}

TEST(Rmse, IsMissingWhereEitherDoesNotCoverTheWindow) {
  const Series full = sampled_evenly(surges, whole, 0.001);
  const Series part = sampled_evenly(surges, {0, 3}, 0.001);
  EXPECT_FALSE(rmse(part, full, whole));
  EXPECT_FALSE(rmse(full, part, whole));
  EXPECT_FALSE(rmse(part, binned(surges, 0.005, 1200), whole));
  EXPECT_TRUE(rmse(part, full, {0, 3}));
}

TEST(Range, IsLargestLessSmallest) {
  const auto wave = [](double t) { return 5 + 3 * std::sin(2 * pi * t); };
  EXPECT_NEAR(*range(sampled_evenly(wave, whole, 0.001), whole), 6, 1e-4);
  EXPECT_NEAR(*range(binned(wave, 0.005, 1200), whole), 6, 1e-4);
  EXPECT_FALSE(range(sampled_evenly(wave, {0, 5}, 0.001), whole));
}

class Shift : public testing::TestWithParam<double> {};

TEST_P(Shift, IsFoundByTheLagOfBestCorrelation) {
  const double shift = GetParam();
  const auto late = [&](double t) { return 1.3 * surges(t - shift) + 50; };
  const Series measured = sampled_evenly(surges, whole, 0.001);
  const auto found = best_lag(sampled_unevenly(late, whole, 0.001), measured, whole, 0.2, 0.001);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lag_s, shift, 1e-4);
  EXPECT_NEAR(found->correlation, 1, 1e-5);
}

TEST_P(Shift, IsFoundUnderNoise) {
  const double shift = GetParam();
  const Series late = with_noise(sampled_evenly([&](double t) { return surges(t - shift); }, whole, 0.001), 100);
  const auto found = best_lag(late, sampled_evenly(surges, whole, 0.001), whole, 0.2, 0.001);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lag_s, shift, 0.003);
  EXPECT_LT(found->correlation, 0.95);
}

INSTANTIATE_TEST_SUITE_P(BothWays, Shift, testing::Values(-0.0314, 0.0, 0.0005, 0.04, 0.15));

TEST(BestLag, IsMissingRatherThanAtTheLimit) {
  const Series measured = sampled_evenly(surges, whole, 0.001);
  const Series late = sampled_evenly([](double t) { return surges(t - 0.3); }, whole, 0.001);
  EXPECT_FALSE(best_lag(late, measured, whole, 0.2, 0.001));
  EXPECT_TRUE(best_lag(late, measured, whole, 0.4, 0.001));
}

TEST(BestLag, OfAConstantOrOfTooShortAWindowIsMissing) {
  const Series measured = sampled_evenly(surges, whole, 0.001);
  const Series constant = sampled_evenly([](double) { return 0.1; }, whole, 0.001);
  EXPECT_FALSE(best_lag(constant, measured, whole, 0.2, 0.001));
  EXPECT_FALSE(best_lag(measured, constant, whole, 0.2, 0.001));
  EXPECT_FALSE(best_lag(measured, measured, {1, 1.7}, 0.2, 0.001));
}

TEST(ShareInsideBand, IsTheTimeBetweenTheBandsEdges) {
  // A ramp from 0 to 6 in a band from 1.5 to 3: a quarter of the time.
  const Series ramp = sampled_unevenly([](double t) { return t; }, whole, 0.7);
  const Series low = sampled_evenly([](double) { return 1.5; }, whole, 1);
  const Series high = sampled_evenly([](double) { return 3.0; }, whole, 0.3);
  EXPECT_NEAR(*share_inside_band(ramp, low, high, whole), 0.25, 1e-12);
  EXPECT_FALSE(share_inside_band(ramp, low, high, {0, 8}));
}

TEST(ShareInsideBand, OfADigestIsWidenedByTheUncertainty) {
  const auto flat = binned([](double) { return 2.0; }, 0.005, 1200);
  const Series ramp = sampled_evenly([](double t) { return t; }, whole, 0.7);
  EXPECT_NEAR(*share_inside_band(ramp, flat, whole, 0), 0, 1e-12);
  EXPECT_NEAR(*share_inside_band(ramp, flat, whole, 0.6), 0.2, 1e-12);
  EXPECT_NEAR(*share_inside_band(sampled_evenly([](double) { return 2.0; }, whole, 0.01), flat, whole, 0), 1, 1e-12);
}

TEST(ABridgedGap, CountsInTheImpulseOnly) {
  auto series = binned([](double) { return 2.0; }, 0.1, 60);
  series.points.assign(60, 3);
  const Series two = sampled_evenly([](double) { return 2.0; }, whole, 0.01);
  for (std::size_t k = 20; k < 40; ++k) {
    series.points[k] = 0;
    series.mean[k] = series.minimum[k] = series.maximum[k] = 7;
  }
  EXPECT_NEAR(*rmse(two, series, whole), 0, 1e-12);
  EXPECT_NEAR(*share_inside_band(two, series, whole, 0), 1, 1e-12);
  EXPECT_FALSE(share_inside_band(two, series, {2.1, 3.9}, 0));
  EXPECT_NEAR(*impulse(series, whole), 22, 1e-9);
}

TEST(Noise, OfAFastSineIsItsRootMeanSquare) {
  // 500 Hz: ten periods in the running mean of 20 ms, which takes nothing of it.
  const auto noisy = [](double t) { return 100 * t + 40 * std::sin(2 * pi * 500 * t); };
  EXPECT_NEAR(*noise(sampled_evenly(noisy, whole, 2e-5), whole), 40 / std::sqrt(2), 0.05);
}

TEST(Noise, OfASmoothCurveIsSmallAndOfALineNothing) {
  EXPECT_NEAR(*noise(sampled_unevenly([](double t) { return 100 * t; }, whole, 0.001), whole), 0, 1e-9);
  EXPECT_LT(*noise(sampled_evenly(surges, whole, 0.001), whole), 3);
  EXPECT_FALSE(noise(sampled_evenly(surges, {0, 2}, 0.001), whole));
}

TEST(Compare, OfAShiftedAndScaledSeriesGivesShiftAndScale) {
  const auto measured = binned(surges, 0.005, 1200);
  const Series simulated = sampled_unevenly([](double t) { return 1.2 * surges(t - 0.02); }, whole, 0.001);
  const Comparison c = compare(simulated, measured, whole);
  EXPECT_EQ(c.sensor, "P1");
  EXPECT_EQ(c.unit, "Pa");
  // The threshold is a tenth of the measured peak for both, so the higher series passes it a little before its shift.
  const double crossing = 1.2 - 0.05 * std::sqrt(2 * std::log(10.0));
  const double crossing_simulated = 1.22 - 0.05 * std::sqrt(2 * std::log(12.0));
  EXPECT_NEAR(*c.arrival_s.measured, crossing, 0.0026);
  EXPECT_NEAR(*c.arrival_s.simulated, crossing_simulated, 1e-4);
  EXPECT_NEAR(*c.peak.deviation(), 0.2, 1e-3);
  EXPECT_NEAR(*c.peak_time_s.difference(), 0.02, 0.0035);
  EXPECT_NEAR(*c.smoothed_peak.deviation(), 0.2, 5e-3);
  EXPECT_NEAR(*c.impulse.deviation(), 0.2, 1e-4);
  EXPECT_NEAR(*c.lag_s, 0.02, 5e-4);
  EXPECT_GT(*c.correlation, 0.9999);
  EXPECT_NEAR(*c.rmse_over_range, *c.rmse / 1000, 1e-6);
  EXPECT_FALSE(c.share_inside_band);
  EXPECT_TRUE(c.remarks.empty());
}

TEST(Compare, OfARunThatStoppedEarlySaysWhatIsMissing) {
  const Series simulated = sampled_evenly(surges, {0, 2}, 0.001);
  const Comparison c = compare(simulated, binned(surges, 0.005, 1200), whole);
  EXPECT_TRUE(c.arrival_s.simulated);
  EXPECT_FALSE(c.peak.simulated);
  EXPECT_FALSE(c.smoothed_peak.simulated);
  EXPECT_FALSE(c.impulse.simulated);
  EXPECT_FALSE(c.impulse.deviation());
  EXPECT_FALSE(c.rmse);
  EXPECT_FALSE(c.lag_s);
  EXPECT_TRUE(c.impulse.measured);
  ASSERT_EQ(c.remarks.size(), 1u);
  EXPECT_EQ(c.remarks[0], "the simulated series covers 2.00 s of a window that ends at 6.00 s");
}

TEST(Compare, OfWideBinsHasNeitherMeanPeakNorNoise) {
  const Series simulated = sampled_evenly(surges, whole, 0.001);
  const Comparison c = compare(simulated, binned(surges, 0.05, 120), whole);
  EXPECT_TRUE(c.peak.measured);
  EXPECT_FALSE(c.smoothed_peak.measured);
  EXPECT_FALSE(c.smoothed_peak_time_s.measured);
  EXPECT_FALSE(c.noise.measured);
  EXPECT_TRUE(c.smoothed_peak.simulated);
  EXPECT_FALSE(compare(simulated, binned(surges, 0.02, 300), whole).noise.measured) << "a mean over one bin";
  EXPECT_TRUE(compare(simulated, binned(surges, 0.01, 600), whole).noise.measured);
}

TEST(Compare, OfASensorThatIsWetFromTheStartHasNoArrival) {
  const auto falling = [](double t) { return 0.55 * std::exp(-t); };
  const Comparison c = compare(sampled_evenly(falling, whole, 0.001), binned(falling, 0.005, 1200), whole);
  EXPECT_FALSE(c.arrival_s.measured);
  EXPECT_FALSE(c.arrival_s.simulated);
  ASSERT_FALSE(c.remarks.empty());
  EXPECT_EQ(c.remarks[0], "no measured arrival: the series is over the threshold from the start");
}

TEST(Compare, WithAnUncertaintyHasAShareInsideTheBand) {
  const auto measured = binned(surges, 0.005, 1200);
  const Series off_by_ten = sampled_evenly([](double t) { return surges(t) + 10; }, whole, 0.001);
  ComparisonOptions options;
  options.band_widening = 9;
  EXPECT_LT(*compare(off_by_ten, measured, whole, options).share_inside_band, 0.5);
  options.band_widening = 11;
  EXPECT_NEAR(*compare(off_by_ten, measured, whole, options).share_inside_band, 1, 1e-9);
}

TEST(Describe, SaysOfASeriesAloneWhatCanBeSaid) {
  const Comparison c = describe(sampled_evenly(surges, whole, 0.001), whole);
  EXPECT_NEAR(*c.peak.simulated, 1000, 0.1);
  EXPECT_TRUE(c.arrival_s.simulated);
  EXPECT_TRUE(c.impulse.simulated);
  EXPECT_FALSE(c.impulse.measured);
  EXPECT_FALSE(c.rmse);
}

}  // namespace
}  // namespace sluice
