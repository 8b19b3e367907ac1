#include "validation/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "validation/synthetic_curves.h"

namespace sluice {
namespace {

using synthetic::binned;
using synthetic::sampled_evenly;
using synthetic::sampled_unevenly;

constexpr Window whole{0, 6};
constexpr double pi = std::numbers::pi;

/// A bell of height 1000, standard width 0.05 s, top at 1.2 s.
double bell(double t) {
  return 1000 * std::exp(-0.5 * std::pow((t - 1.2) / 0.05, 2));
}

TEST(Covers, ForgivesOneSamplingIntervalAtAnEnd) {
  const Series series = sampled_evenly([](double) { return 1.0; }, {0.0009, 5.9991}, 0.001);
  EXPECT_TRUE(covers(series, whole));
  EXPECT_FALSE(covers(series, {-0.01, 6}));
  EXPECT_FALSE(covers(series, {0, 6.01}));
  EXPECT_FALSE(covers(series, {6, 6}));
  EXPECT_FALSE(covers(Series{"", "", {0}, {1}}, {0, 0.1}));
  EXPECT_FALSE(covers(Series{}, whole));
  EXPECT_FALSE(covers(Series{"", "", {1, 5}, {1, 1}}, whole)) << "an interval is little where the window is long";
}

/// Rows of a code that chooses its time steps, 2.5 to 39 ms apart and 10.5 ms mostly, with a short interval at both
/// ends.
Series adaptively_sampled(double begin_s, double end_s) {
  Series series{"", "", {begin_s, begin_s + 0.0025}, {}};
  const double intervals_s[] = {0.0105, 0.004, 0.0105, 0.039, 0.0105};
  for (std::size_t k = 0; series.t_s.back() < end_s - 0.045; ++k)
    series.t_s.push_back(series.t_s.back() + intervals_s[k % 5]);
  series.t_s.push_back(end_s - 0.0025);
  series.t_s.push_back(end_s);
  series.value.assign(series.t_s.size(), 1.0);
  return series;
}

TEST(Covers, ForgivesTheUsualIntervalWhereThatAtTheEndHappensToBeShort) {
  const Series series = adaptively_sampled(0.0089, 5.9957);
  EXPECT_TRUE(covers(series, whole));
  EXPECT_TRUE(reaches_end(series, whole));
  EXPECT_NEAR(impulse(series, whole).value(), 5.9868, 1e-9);
  EXPECT_EQ(coverage_remark(series, whole), "");
  EXPECT_FALSE(reaches_end(adaptively_sampled(0, 5.989), whole)) << "more than one interval is missing";
  EXPECT_FALSE(covers(adaptively_sampled(0.011, 6), whole)) << "the same at the begin";
  EXPECT_FALSE(reaches_end(adaptively_sampled(0, 5.8909), whole));
  EXPECT_FALSE(covers(Series{"", "", {0, 3, 5.7}, {1, 1, 1}}, {0, 6.6})) << "an interval is little";
}

TEST(Covers, ARemarkTellsApartWhatLiesClose) {
  const Series series = sampled_evenly([](double) { return 1.0; }, {0, 5.996}, 0.001);
  EXPECT_EQ(coverage_remark(series, whole), "covers 5.996 s of a window that ends at 6 s");
  const Series late = sampled_evenly([](double) { return 1.0; }, {1.00004, 1.1}, 0.00001);
  EXPECT_EQ(coverage_remark(late, {1, 1.1}), "begins at 1.00004 s, the window at 1 s");
}

// Where rows are missing a straight line would be drawn through the impact.
TEST(Covers, ForgivesNoGapInside) {
  Series series = sampled_evenly(bell, whole, 0.001);
  EXPECT_FALSE(first_gap(series, whole));
  EXPECT_EQ(coverage_remark(series, whole), "");
  series.t_s.erase(series.t_s.begin() + 1100, series.t_s.begin() + 1300);
  series.value.erase(series.value.begin() + 1100, series.value.begin() + 1300);
  const auto gap = first_gap(series, whole);
  ASSERT_TRUE(gap);
  EXPECT_NEAR(gap->begin_s, 1.099, 1e-9);
  EXPECT_NEAR(gap->end_s, 1.3, 1e-9);
  EXPECT_FALSE(covers(series, whole));
  EXPECT_FALSE(impulse(series, whole));
  EXPECT_EQ(coverage_remark(series, whole), "has no rows between 1.099 and 1.3 s");
  EXPECT_TRUE(covers(series, {0, 1.05})) << "before it";
  EXPECT_TRUE(covers(series, {1.3, 6})) << "after it";
  EXPECT_FALSE(arrival_time(series, whole, 500)) << "it may lie in the gap";
  EXPECT_TRUE(arrival_time(series, whole, 10)) << "before it";
}

TEST(Covers, IntervalsOfManyLengthsAreNoGap) {
  Series series = sampled_evenly(bell, {0, 1}, 0.05);
  const Series fine = sampled_evenly(bell, {1.001, 6}, 0.001);
  series.t_s.insert(series.t_s.end(), fine.t_s.begin(), fine.t_s.end());
  series.value.insert(series.value.end(), fine.value.begin(), fine.value.end());
  EXPECT_TRUE(covers(series, whole));
}

TEST(CommonWindow, IsWhatBothReach) {
  const Series early = sampled_evenly([](double) { return 1.0; }, {0, 2}, 0.1);
  const Series late = sampled_evenly([](double) { return 1.0; }, {1, 5}, 0.1);
  const auto common = common_window(early, late, whole);
  ASSERT_TRUE(common);
  EXPECT_DOUBLE_EQ(common->begin_s, 1);
  EXPECT_DOUBLE_EQ(common->end_s, 2);
  EXPECT_FALSE(common_window(early, late, {3, 4}));
}

TEST(ValueAt, InterpolatesAndNeverExtrapolates) {
  const Series line{"", "", {0, 1, 4}, {0, 10, 40}};
  EXPECT_DOUBLE_EQ(*value_at(line, 0), 0);
  EXPECT_DOUBLE_EQ(*value_at(line, 1), 10);
  EXPECT_DOUBLE_EQ(*value_at(line, 2.5), 25);
  EXPECT_DOUBLE_EQ(*value_at(line, 4), 40);
  EXPECT_FALSE(value_at(line, -0.001));
  EXPECT_FALSE(value_at(line, 4.001));
}

TEST(PeakMetric, IsTheLargestSampleInTheWindow) {
  const Series series = sampled_evenly(bell, whole, 0.001);
  const auto found = peak(series, whole);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 1000, 1e-9);
  EXPECT_NEAR(found->time_s, 1.2, 1e-9);
  EXPECT_NEAR(peak(series, {0, 1.15})->value, bell(1.15), 1e-9);
}

TEST(PeakMetric, IsMissingWhenTheRunStoppedEarly) {
  const Series series = sampled_evenly(bell, {0, 2}, 0.001);
  EXPECT_FALSE(peak(series, whole));
  EXPECT_TRUE(peak(series, {0, 2}));
}

TEST(PeakMetric, OfBinsIsTheLargestMaximum) {
  const auto series = binned(bell, 0.005, 1200);
  EXPECT_NEAR(peak(series, whole)->value, 1000, 1e-9);
  EXPECT_NEAR(peak(series, whole)->time_s, 1.2, 0.0025001);
  EXPECT_FALSE(peak(series, {0, 6.5}));
}

TEST(RunningMean, LeavesAStraightLineAsItIsOnUnevenSamples) {
  const Series line = sampled_unevenly([](double t) { return 3 * t - 1; }, whole, 0.001);
  const Series mean = running_mean(line, 0.02);
  for (std::size_t i = 0; i < line.t_s.size(); ++i) ASSERT_NEAR(mean.value[i], line.value[i], 1e-9);
}

TEST(RunningMean, DampsASineByTheKnownFactor) {
  const double frequency = 20;
  const double width = 0.02;
  const auto sine = [&](double t) { return std::sin(2 * pi * frequency * t); };
  const Series mean = running_mean(sampled_unevenly(sine, whole, 1e-4), width);
  const double factor = std::sin(pi * frequency * width) / (pi * frequency * width);
  for (std::size_t i = 0; i < mean.t_s.size(); ++i) {
    if (mean.t_s[i] < width || mean.t_s[i] > 6 - width) continue;
    ASSERT_NEAR(mean.value[i], factor * sine(mean.t_s[i]), 1e-4);
  }
}

TEST(RunningMean, IsWeightedWithTimeNotWithSamples) {
  // A hundred samples crowd where the value is 1; the mean of a step over a window centred on it is still one half.
  Series step{"", "", {}, {}};
  for (int i = 0; i <= 10; ++i) step.t_s.push_back(-1 + 0.1 * i - 1e-9), step.value.push_back(0);
  for (int i = 0; i <= 1000; ++i) step.t_s.push_back(0.001 * i), step.value.push_back(1);
  const Series mean = running_mean(step, 1.0);
  EXPECT_NEAR(mean.value[11], 0.5, 1e-6);
}

TEST(RunningMean, OfBinsIsExactAtTheirEdges) {
  const auto series = binned(bell, 0.005, 1200);
  const Series mean = running_mean(series, 0.01);
  ASSERT_EQ(mean.t_s.size(), 1199u);
  EXPECT_NEAR(mean.t_s.front(), 0.005, 1e-12);
  for (std::size_t k = 0; k < mean.t_s.size(); ++k) {
    ASSERT_NEAR(mean.value[k], 0.5 * (series.mean[k] + series.mean[k + 1]), 1e-9);
  }
}

TEST(SmoothedPeak, TakesASpikeForWhatItHolds) {
  // A spike 1 ms wide at its foot and 20000 high on a plateau of 500: 10 Pa s over 10 ms add 1000 to the mean.
  const auto spiked = [](double t) { return 500 + 20000 * std::max(0.0, 1 - std::abs(t - 2) / 0.0005); };
  const Series series = sampled_evenly(spiked, whole, 0.0001);
  EXPECT_NEAR(peak(series, whole)->value, 20500, 1e-6);
  EXPECT_NEAR(smoothed_peak(series, whole, 0.01)->value, 1500, 1e-6);
  EXPECT_FALSE(smoothed_peak(series, {0, 7}, 0.01));
}

TEST(SmoothedPeak, OfBinsUsesTheDigestsOwnWhereTheWidthAgrees) {
  auto series = binned(bell, 0.005, 1200);
  const double from_bins = smoothed_peak(series, whole, 0.01)->value;
  series.smoothing_s = 0.01;
  series.smoothed_maximum.assign(1200, 1);
  series.smoothed_maximum[700] = 999;
  EXPECT_EQ(smoothed_peak(series, whole, 0.01)->value, 999);
  EXPECT_NEAR(smoothed_peak(series, whole, 0.01)->time_s, 700.5 * 0.005, 1e-9);
  EXPECT_EQ(smoothed_peak(series, whole, 0.02)->value, smoothed_peak(binned(bell, 0.005, 1200), whole, 0.02)->value);
  EXPECT_NEAR(from_bins, 1000, 5);
}

TEST(SmoothedPeak, OfBinsWiderThanTheMeanIsMissing) {
  MeasuredSeries series = binned(bell, 0.05, 120);
  EXPECT_FALSE(smoothed_peak(series, whole, 0.01));
  EXPECT_TRUE(smoothed_peak(series, whole, 0.05));
  series.smoothing_s = 0.01;
  series.smoothed_maximum.assign(120, 7);
  EXPECT_EQ(smoothed_peak(series, whole, 0.01)->value, 7) << "of the unbinned samples";
}

TEST(SmoothedPeak, OfBinsTakesNothingFromOutsideTheWindow) {
  const MeasuredSeries falling = binned([](double t) { return 6 - t; }, 0.005, 1200);
  EXPECT_NEAR(smoothed_peak(falling, {1, 5}, 0.01)->value, 4.995, 1e-9) << "the mean of 1.00 to 1.01 s";
  EXPECT_NEAR(smoothed_peak(falling, {1, 5}, 0.01)->time_s, 1.005, 1e-9);
}

TEST(Arrival, IsInterpolatedOnARamp) {
  const auto ramp = [](double t) { return std::max(0.0, t - 1.0) * 100; };
  EXPECT_NEAR(*arrival_time(sampled_unevenly(ramp, whole, 0.01), whole, 25), 1.25, 1e-9);
  EXPECT_NEAR(*arrival_at_fraction_of_peak(sampled_evenly(ramp, whole, 0.01), whole), 1.5, 1e-9);
}

TEST(Arrival, MovesWithAShiftAndStaysUnderAScale) {
  const double base = *arrival_at_fraction_of_peak(sampled_evenly(bell, whole, 1e-4), whole);
  EXPECT_NEAR(base, 1.2 - 0.05 * std::sqrt(2 * std::log(10.0)), 1e-5);
  const auto late = [](double t) { return 3 * bell(t - 0.0321); };
  EXPECT_NEAR(*arrival_at_fraction_of_peak(sampled_evenly(late, whole, 1e-4), whole), base + 0.0321, 1e-5);
}

TEST(Arrival, IsMissingWhereThereIsNone) {
  const auto ramp = [](double t) { return t; };
  const Series series = sampled_evenly(ramp, whole, 0.01);
  EXPECT_FALSE(arrival_time(series, whole, 6.5));                                        // never
  EXPECT_FALSE(arrival_time(series, {2, 6}, 1.5));                                       // from the start
  EXPECT_FALSE(arrival_time(series, {0, 2}, 2.5));                                       // after the window
  EXPECT_FALSE(arrival_time(sampled_evenly(ramp, {1, 6}, 0.01), whole, 2));              // began too late to tell
  EXPECT_FALSE(arrival_at_fraction_of_peak(sampled_evenly(ramp, {0, 3}, 0.01), whole));  // its peak is not known
  EXPECT_TRUE(arrival_time(sampled_evenly(ramp, {0, 3}, 0.01), whole, 2));               // crossed before it stopped
}

TEST(Arrival, OfBinsIsGoodToHalfABin) {
  const auto front = [](double t) { return t < 1.2034 ? 0.0 : 1000.0 + t; };
  EXPECT_NEAR(*arrival_at_fraction_of_peak(binned(front, 0.005, 1200), whole), 1.2034, 0.0026);
  const double smooth = *arrival_at_fraction_of_peak(binned(bell, 0.005, 1200), whole);
  EXPECT_NEAR(smooth, 1.2 - 0.05 * std::sqrt(2 * std::log(10.0)), 0.0026);
  EXPECT_FALSE(arrival_time(binned([](double) { return 1.0; }, 0.005, 100), {0, 0.5}, 0.1));
}

TEST(Impulse, OfABellIsKnown) {
  const double known = 1000 * 0.05 * std::sqrt(2 * pi);
  EXPECT_NEAR(*impulse(sampled_evenly(bell, whole, 0.001), whole), known, 1e-6);
  EXPECT_NEAR(*impulse(sampled_unevenly(bell, whole, 0.001), whole), known, 2e-3);
  EXPECT_NEAR(*impulse(binned(bell, 0.005, 1200), whole), known, 1e-6);
}

TEST(Impulse, InterpolatesAtTheWindowsEnds) {
  const Series line = sampled_evenly([](double t) { return 2 * t; }, whole, 0.7);
  EXPECT_NEAR(*impulse(line, {0.35, 4.1}), 4.1 * 4.1 - 0.35 * 0.35, 1e-12);
  EXPECT_NEAR(*impulse(binned([](double) { return 7.0; }, 0.005, 1200), {0.0012, 0.0157}), 7 * 0.0145, 1e-12);
}

TEST(Impulse, IsMissingWhereTheWindowIsNotCovered) {
  EXPECT_FALSE(impulse(sampled_evenly(bell, {0, 5.9}, 0.001), whole));
  EXPECT_FALSE(impulse(sampled_evenly(bell, {0.1, 6}, 0.001), whole));
  EXPECT_FALSE(impulse(binned(bell, 0.005, 1199), whole));
}

TEST(RelativeDeviation, IsSignedOrAsThePaperHasIt) {
  EXPECT_DOUBLE_EQ(*relative_deviation(80, 100), -0.2);
  EXPECT_DOUBLE_EQ(*relative_deviation(120, 100), 0.2);
  EXPECT_DOUBLE_EQ(*unsigned_relative_deviation(80, 100), 0.2);
  EXPECT_FALSE(relative_deviation(std::nullopt, 100));
  EXPECT_FALSE(relative_deviation(80, std::nullopt));
  EXPECT_FALSE(relative_deviation(80, 0));
}

}  // namespace
}  // namespace sluice
