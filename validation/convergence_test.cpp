#include "validation/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sluice {
namespace {

std::vector<ResolvedValue> power_law(double limit, double factor, double order, const std::vector<double>& l0_m) {
  std::vector<ResolvedValue> results;
  for (const double l0 : l0_m) results.push_back({l0, limit + factor * std::pow(l0, order)});
  return results;
}

TEST(GridConvergence, FindsAKnownOrderAndLimitAtUnequalRatios) {
  const auto found = grid_convergence(power_law(10, 400, 1.7, {0.02, 0.04, 0.03}));
  ASSERT_TRUE(found.asymptotic);
  EXPECT_EQ(found.verdict(), "in the asymptotic range");
  EXPECT_NEAR(*found.order, 1.7, 1e-8);
  EXPECT_NEAR(*found.extrapolated, 10, 1e-8);
  const double finest = 10 + 400 * std::pow(0.02, 1.7);
  EXPECT_NEAR(*found.index, 3 * (finest - 10) / finest, 1e-8) << "an order that is not the formal one";
}

TEST(GridConvergence, TrustsNoMoreThanTheFormalOrder) {
  // Differences 1 and 6 at a ratio of 2: order 2.58, taken as 2.
  const auto found = grid_convergence({{0.01, 5}, {0.02, 6}, {0.04, 12}});
  EXPECT_NEAR(*found.order, std::log2(6.0), 1e-9);
  EXPECT_NEAR(*found.extrapolated, 5 - 1.0 / 3, 1e-9);
  EXPECT_NEAR(*found.index, 3.0 / 15, 1e-9);
}

TEST(GridConvergence, AgreesWithTheClosedFormAtEqualRatios) {
  // Differences 1 and 4 at a ratio of 2: order 2; limit 5 - 1/3.
  const auto found = grid_convergence({{0.01, 5}, {0.02, 6}, {0.04, 10}});
  EXPECT_NEAR(*found.order, 2, 1e-9);
  EXPECT_NEAR(*found.extrapolated, 5 - 1.0 / 3, 1e-9);
  EXPECT_NEAR(*found.index, 1.25 / 15, 1e-9);
}

TEST(GridConvergence, AnOscillatingResultIsNotInTheAsymptoticRange) {
  const auto found = grid_convergence({{0.01, 5}, {0.02, 6}, {0.04, 4}});
  EXPECT_EQ(found.verdict(), "not in the asymptotic range");
  EXPECT_FALSE(found.order);
  EXPECT_FALSE(found.extrapolated);
  EXPECT_FALSE(found.index);
}

TEST(GridConvergence, ADivergingResultIsNotInTheAsymptoticRange) {
  EXPECT_FALSE(grid_convergence({{0.01, 9}, {0.02, 6}, {0.04, 5}}).order);
  EXPECT_FALSE(grid_convergence({{0.01, 5}, {0.02, 5}, {0.04, 5}}).asymptotic);
}

TEST(GridConvergence, AnImplausibleOrderIsShownButNotTrusted) {
  const auto found = grid_convergence(power_law(10, 4e8, 6, {0.01, 0.02, 0.03}));
  EXPECT_NEAR(*found.order, 6, 1e-6);
  EXPECT_FALSE(found.asymptotic);
  EXPECT_FALSE(found.index);
}

TEST(GridConvergence, ACoarserGridOutsideTheRangeIsNotIgnored) {
  auto results = power_law(10, 400, 2, {0.01, 0.015, 0.02});
  EXPECT_TRUE(grid_convergence(results).asymptotic);
  results.push_back({0.03, 10});
  EXPECT_FALSE(grid_convergence(results).asymptotic);
}

TEST(GridConvergence, RefusesWhatIsNoRefinementStudy) {
  EXPECT_THROW(grid_convergence({{0.01, 1}, {0.02, 2}}), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{0.01, 1}, {0.01, 2}, {0.02, 3}}), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{0, 1}, {0.01, 2}, {0.02, 3}}), std::invalid_argument);
}

}  // namespace
}  // namespace sluice
