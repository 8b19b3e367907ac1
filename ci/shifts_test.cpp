#include "ci/shifts.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "ci/nile.h"

namespace sluice::ci {
namespace {

std::vector<double> noise(std::size_t n, std::uint64_t seed, double scatter = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, scatter);
  std::vector<double> values(n);
  for (double& value : values) value = normal(random);
  return values;
}

void add_step(std::vector<double>& values, std::size_t first, double size) {
  for (std::size_t i = first; i < values.size(); ++i) values[i] += size;
}

constexpr Tolerance any_size;
constexpr Tolerance exact{.absolute = 0.01, .relative = 0, .repeatable = true};

TEST(Scatter, KnownAnswers) {
  EXPECT_EQ(median(std::vector<double>{}), 0);
  EXPECT_EQ(median(std::vector{3.0, 1.0, 2.0}), 2);
  EXPECT_EQ(median(std::vector{4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(trimmed_mean(std::vector<double>{}), 0);
  EXPECT_EQ(trimmed_mean(std::vector{1.0, 2.0, 6.0}), 3);
  EXPECT_EQ(trimmed_mean(std::vector{100.0, 1.0, 2.0, 3.0, 6.0, -50.0}), 3);
  EXPECT_EQ(scatter_of({}), 0);
  EXPECT_EQ(scatter_of(std::vector<double>(9, 0.0)), 0);
  EXPECT_NEAR(scatter_of(noise(100000, 1, 2.5)), 2.5, 0.03);
}

TEST(Scatter, OneWildValueHardlyMatters) {
  std::vector<double> residuals = noise(60, 2);
  const double before = scatter_of(residuals);
  residuals.push_back(1000);
  EXPECT_LT(scatter_of(residuals), 1.15 * before);
}

// More than half of the values are equal: their spread is not zero for that.
TEST(Scatter, SeldomChangesCountInFull) {
  std::vector<double> residuals(20, 0.0);
  residuals[3] = residuals[9] = 3;
  EXPECT_NEAR(scatter_of(residuals), 1, 1e-12);
}

TEST(FindShifts, TellsStepFromNoise) {
  std::vector<double> values = noise(100, 11);
  EXPECT_TRUE(find_shifts(values, any_size).empty());
  add_step(values, 70, 5);
  const auto shifts = find_shifts(values, any_size);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_EQ(shifts[0].first, 70u);
  EXPECT_LE(shifts[0].found, 73u);
  EXPECT_NEAR(shifts[0].before, 0, 0.5);
  EXPECT_NEAR(shifts[0].scatter, 1, 0.25);
  EXPECT_GT(shifts[0].after - shifts[0].before, shifts[0].threshold);
  ASSERT_TRUE(shifts[0].p_value);
  EXPECT_LE(*shifts[0].p_value, 0.01);
}

// What a night said is what it would have said had the later ones never come.
TEST(FindShifts, LaterNightsDoNotChangeEarlierAnswers) {
  std::vector<double> values = noise(160, 5);
  add_step(values, 60, 4);
  add_step(values, 110, -6);
  const auto all = find_shifts(values, any_size);
  ASSERT_EQ(all.size(), 2u);
  for (std::size_t nights = 1; nights <= values.size(); ++nights) {
    const auto then = find_shifts(std::span(values).first(nights), any_size);
    std::size_t expected = 0;
    while (expected < all.size() && all[expected].found < nights) ++expected;
    ASSERT_EQ(then.size(), expected) << nights;
    for (std::size_t i = 0; i < expected; ++i) {
      EXPECT_EQ(then[i].first, all[i].first);
      EXPECT_EQ(then[i].found, all[i].found);
    }
  }
}

TEST(FindShifts, OneOrTwoWildNightsAreNoShift) {
  std::vector<double> values = noise(80, 6);
  values[50] += 30;
  values[65] += 12;
  values[66] += 12;
  EXPECT_TRUE(find_shifts(values, any_size).empty());
}

// In the first month the scatter is little more than a guess: only what is beyond doubt is told.
TEST(FindShifts, AShortSeriesIsJudgedWithCaution) {
  std::vector<double> values = noise(22, 31);
  add_step(values, 16, 5);
  EXPECT_TRUE(find_shifts(values, any_size).empty());
  add_step(values, 16, 10);
  ASSERT_EQ(find_shifts(values, any_size).size(), 1u);
  EXPECT_EQ(find_shifts(values, any_size)[0].first, 16u);
}

TEST(FindShifts, ASlowDriftIsFoundInTheEnd) {
  std::vector<double> values = noise(200, 8);
  for (std::size_t i = 60; i < values.size(); ++i) values[i] += 0.1 * static_cast<double>(i - 60);
  const auto shifts = find_shifts(values, any_size);
  ASSERT_FALSE(shifts.empty());
  EXPECT_LT(shifts[0].found, 120u);
}

// A year of steps that nobody reacts to: each is told once, from the level that the one before has left.
TEST(FindShifts, EachStepOfAStaircaseIsTold) {
  std::vector<double> values = noise(200, 9);
  for (const std::size_t first : {50u, 100u, 150u}) add_step(values, first, 6);
  const auto shifts = find_shifts(values, any_size);
  ASSERT_EQ(shifts.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(shifts[i].before, 6.0 * static_cast<double>(i), 0.8);
    EXPECT_NEAR(static_cast<double>(shifts[i].first), 50.0 * static_cast<double>(i + 1), 1);
  }
}

TEST(FindShifts, BelowTheToleranceIsNotWorthTelling) {
  std::vector<double> values = noise(80, 12, 0.001);
  add_step(values, 50, 0.02);
  EXPECT_EQ(find_shifts(values, any_size).size(), 1u);
  EXPECT_EQ(find_shifts(values, {.absolute = 0.015}).size(), 1u);
  EXPECT_TRUE(find_shifts(values, {.absolute = 0.03}).empty());
  for (double& value : values) value += 1;
  EXPECT_EQ(find_shifts(values, {.relative = 0.015}).size(), 1u);
  EXPECT_TRUE(find_shifts(values, {.relative = 0.03}).empty());
}

TEST(FindShifts, AQuietRepeatableSeriesNeedsOneNight) {
  std::vector<double> values(8, 0.05);
  values.push_back(0.07);
  const auto shifts = find_shifts(values, exact);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_EQ(shifts[0].first, 8u);
  EXPECT_EQ(shifts[0].found, 8u);
  EXPECT_EQ(shifts[0].after, 0.07);
  EXPECT_FALSE(shifts[0].p_value);
  EXPECT_TRUE(find_shifts(values, {.absolute = 0.01}).empty()) << "a noisy metric must wait for confirmation";
  EXPECT_TRUE(find_shifts(std::span(values).last(4), exact).empty()) << "three values are no history";
  // And back again, the next night.
  values.push_back(0.05);
  const auto both = find_shifts(values, exact);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].first, 9u);
}

TEST(FindShifts, ARepeatableSeriesOfSeveralMachinesIsJudgedByItsScatter) {
  std::vector<double> values;
  for (int i = 0; i < 60; ++i) values.push_back(i % 2 == 0 ? 0.05 : 0.08);
  EXPECT_TRUE(find_shifts(values, exact).empty());
  add_step(values, 48, 0.12);
  const auto shifts = find_shifts(values, exact);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_EQ(shifts[0].first, 48u);
  EXPECT_TRUE(shifts[0].p_value);
}

TEST(FindShifts, IsTheSameForTheMirroredSeries) {
  std::vector<double> values = noise(90, 21);
  add_step(values, 60, 4);
  const auto up = find_shifts(values, any_size);
  for (double& value : values) value = -value;
  const auto down = find_shifts(values, any_size);
  ASSERT_EQ(up.size(), down.size());
  for (std::size_t i = 0; i < up.size(); ++i) {
    EXPECT_EQ(up[i].first, down[i].first);
    EXPECT_EQ(up[i].found, down[i].found);
    EXPECT_EQ(up[i].after, -down[i].after);
  }
}

TEST(FindShifts, ShortOrEmptySeriesSayNothing) {
  EXPECT_TRUE(find_shifts({}, exact).empty());
  EXPECT_TRUE(find_shifts(std::vector{1.0}, exact).empty());
  EXPECT_TRUE(find_shifts(std::vector{1.0, 9.0, 9.0, 9.0}, exact).empty());
}

// Cobb's change of 1898 (nile.h), with the figures that nightly alarms use: one shift, in its year. It is of two
// standard deviations, so that it takes decades to be sure of it.
TEST(FindShifts, TheNile) {
  const auto shifts = find_shifts(nile_flow, any_size);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_EQ(1871 + shifts[0].first, 1899u);
  EXPECT_GT(1871 + shifts[0].found, 1920u);
}

}  // namespace
}  // namespace sluice::ci
