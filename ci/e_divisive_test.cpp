#include "ci/e_divisive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "ci/nile.h"

namespace sluice::ci {
namespace {

std::vector<double> normal_values(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(n);
  for (double& value : values) value = normal(random);
  return values;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(EnergyStatistic, KnownByHand) {
  // E = 2 * 1 - 0 - 0, Q = 2 * 2 / 4 * 2.
  EXPECT_DOUBLE_EQ(energy_statistic(std::vector{0.0, 0.0}, std::vector{1.0, 1.0}), 2);
  // Between: (2 + 6 + 1 + 5 + 0 + 4) / 6 = 3; within x: (1 + 2 + 1) / 3 pairs; within y: 4. E = 6 - 4/3 - 4 = 2/3,
  // Q = 6/5 * 2/3.
  EXPECT_DOUBLE_EQ(energy_statistic(std::vector{0.0, 1.0, 2.0}, std::vector{2.0, 6.0}), 0.8);
  EXPECT_DOUBLE_EQ(energy_statistic(std::vector{3.0}, std::vector{5.0}), 2);
}

TEST(EDivisive, AgreesWithTheDefinitionTriedAtEveryPlace) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::vector<double> values = normal_values(24, seed);
    for (std::size_t i = 15; i < values.size(); ++i) values[i] += 6;
    double greatest = 0;
    std::size_t at = 0;
    const std::span<const double> all(values);
    for (std::size_t first = 3; first + 3 <= values.size(); ++first)
      for (std::size_t end = first + 3; end <= values.size(); ++end)
        if (const double q = energy_statistic(all.first(first), all.subspan(first, end - first)); q > greatest) {
          greatest = q;
          at = first;
        }
    const auto divisions = e_divisive(values);
    ASSERT_FALSE(divisions.empty());
    const auto found =
        std::find_if(divisions.begin(), divisions.end(), [&](const Division& d) { return d.first == at; });
    ASSERT_NE(found, divisions.end()) << seed;
    EXPECT_NEAR(found->statistic, greatest, 1e-9 * greatest);
  }
}

// The change of 1898 that Cobb's conditional solution and every later method finds: 1899 is the first year of the new
// level, and there is no second change.
TEST(EDivisive, FindsTheChangeOfTheNile) {
  ASSERT_NEAR(mean(std::span(nile_flow).first(28)), 1097.75, 0.005);
  ASSERT_NEAR(mean(std::span(nile_flow).subspan(28)), 849.97, 0.005);
  const auto divisions = e_divisive(nile_flow);
  ASSERT_EQ(divisions.size(), 1u);
  EXPECT_EQ(1871 + divisions[0].first, 1899u);
  EXPECT_DOUBLE_EQ(divisions[0].p_value, 1 / 200.0);
}

TEST(EDivisive, FindsSeveralChangesInPlace) {
  std::vector<double> values = normal_values(120, 7);
  for (std::size_t i = 40; i < 80; ++i) values[i] += 8;
  for (std::size_t i = 80; i < 120; ++i) values[i] -= 5;
  const auto divisions = e_divisive(values);
  ASSERT_EQ(divisions.size(), 2u);
  EXPECT_EQ(divisions[0].first, 40u);
  EXPECT_EQ(divisions[1].first, 80u);
  EXPECT_EQ(possible_divisions(std::vector<double>(50, 1.0), 3).size(), 0u);
}

// Under noise alone a test at 1 % says "change" about once in a hundred series.
TEST(EDivisive, KeepsItsSignificance) {
  int series_with_change = 0;
  for (std::uint64_t seed = 100; seed < 500; ++seed) series_with_change += !e_divisive(normal_values(40, seed)).empty();
  EXPECT_LE(series_with_change, 10);
  EXPECT_GE(series_with_change, 1);
}

TEST(EDivisive, DependsOnTheValuesAlone) {
  std::vector<double> values = normal_values(60, 3);
  for (std::size_t i = 50; i < 60; ++i) values[i] += 3;
  const auto once = e_divisive(values);
  const auto again = e_divisive(values);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].first, again[i].first);
    EXPECT_EQ(once[i].p_value, again[i].p_value);
  }
  for (double& value : values) value = 1e6 + 1e-3 * value;
  const auto scaled = e_divisive(values);
  ASSERT_EQ(scaled.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(scaled[i].first, once[i].first);
}

TEST(EDivisive, PossibleDivisionsIncludeThoseFound) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> values = normal_values(70, seed);
    for (std::size_t i = 30; i < 70; ++i) values[i] += 2;
    for (std::size_t i = 64; i < 70; ++i) values[i] += 4;
    const auto possible = possible_divisions(values, 3);
    for (const Division& division : e_divisive(values))
      EXPECT_NE(std::find(possible.begin(), possible.end(), division.first), possible.end()) << seed;
  }
}

TEST(EDivisive, HasNothingToSayOfConstantOrShortSeries) {
  EXPECT_TRUE(e_divisive(std::vector<double>(30, 4.2)).empty());
  EXPECT_TRUE(e_divisive(std::vector<double>{1, 2, 3, 4, 5}).empty());
  EXPECT_TRUE(e_divisive(std::vector<double>{}).empty());
}

}  // namespace
}  // namespace sluice::ci
