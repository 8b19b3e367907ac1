#include "validation/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sluice {
namespace {

std::vector<PredictedAndMeasured> log_normal_pairs(std::size_t count, double mean, double deviation,
                                                   unsigned seed = 3) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(mean, deviation);
  std::vector<PredictedAndMeasured> pairs(count);
  for (auto& pair : pairs) {
    pair.measured = 50;
    pair.predicted = 50 * std::exp(normal(random));
  }
  return pairs;
}

TEST(BiasAndScatter, OfThreePairsByHand) {
  // Logarithms -0.1, 0, 0.4: mean 0.1, variance 0.07.
  const auto found = bias_and_scatter({{std::exp(-0.1), 1}, {2, 2}, {3 * std::exp(0.4), 3}, {0, 1}, {1, 0}, {-1, -1}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pairs, 3U);
  EXPECT_EQ(found->left_out, 3U);
  EXPECT_NEAR(found->scatter, std::sqrt(0.07), 1e-12);
  EXPECT_NEAR(found->bias, std::exp(0.1 + 0.035), 1e-12);
  EXPECT_FALSE(found->bias_interval) << "three pairs say nothing of how sure that is";
  EXPECT_FALSE(bias_and_scatter({{1, 1}, {1, 1}}));
}

TEST(BiasAndScatter, TheMeasurementsOwnScatterIsNotTheModels) {
  const auto pairs = log_normal_pairs(20000, 0.2, 0.13);
  const auto found = bias_and_scatter(pairs, 0.12);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scatter, 0.05, 0.005);
  EXPECT_NEAR(found->bias, std::exp(0.2 + 0.5 * (0.05 * 0.05 - 0.12 * 0.12)), 0.005);
  EXPECT_EQ(bias_and_scatter(pairs, 0.5)->scatter, 0) << "explained by the measurement alone";
  EXPECT_THROW(bias_and_scatter(pairs, -0.1), std::invalid_argument);
}

/// Of a hundred samples about 95 hold the truth, if the interval is what it says (the percentile method is a little too
/// narrow).
TEST(BiasAndScatter, IntervalsHoldTheTruthAsOftenAsTheySay) {
  int bias_held = 0;
  int scatter_held = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const auto found = bias_and_scatter(log_normal_pairs(40, 0.1, 0.2, seed));
    const double bias = std::exp(0.1 + 0.02);
    bias_held += found->bias_interval->lower <= bias && bias <= found->bias_interval->upper;
    scatter_held += found->scatter_interval->lower <= 0.2 && 0.2 <= found->scatter_interval->upper;
  }
  EXPECT_GE(bias_held, 88);
  EXPECT_GE(scatter_held, 82);
}

TEST(BiasAndScatter, IsTheSameEveryTime) {
  const auto pairs = log_normal_pairs(9, 0, 0.3);
  EXPECT_EQ(bias_and_scatter(pairs)->bias_interval->lower, bias_and_scatter(pairs)->bias_interval->lower);
}

TEST(ValidationUncertainty, IsTheRootOfTheSquaresOfWhatIsKnown) {
  ValidationUncertainty v{.error = 9, .of_resolution = {}, .of_input = {}, .of_measurement = {}};
  EXPECT_FALSE(v.total());
  EXPECT_FALSE(v.within());
  v.of_resolution = 3;
  v.of_measurement = 4;
  EXPECT_NEAR(*v.total(), 5, 1e-12);
  EXPECT_TRUE(*v.within());
  EXPECT_FALSE(v.complete());
  v.of_input = 0;
  EXPECT_TRUE(v.complete());
  v.error = -10.1;
  EXPECT_FALSE(*v.within());
}

TEST(ValidationUncertainty, OfResolutionFollowsFromTheGridConvergenceIndex) {
  // f = 10 + l0: order 1, extrapolated 10, index 3 * 1 / 11 at l0 = 1.
  const GridConvergence c = grid_convergence({{1, 11}, {2, 12}, {4, 14}});
  EXPECT_NEAR(*resolution_uncertainty(c, 11), 3 / 1.15, 1e-6);
  EXPECT_FALSE(resolution_uncertainty(grid_convergence({{1, 11}, {2, 10}, {4, 14}}), 11));
}

TEST(ValidationUncertainty, OfABandIsItsOwnWidth) {
  MeasuredSeries band;
  band.bin_s = 0.1;
  band.t_s = {0.05, 0.15, 0.25};
  band.mean = {1, 5, 2};
  band.minimum = {0, 4, 2};
  band.maximum = {2, 7, 2};
  EXPECT_FALSE(impulse_uncertainty(band, {0, 0.3})) << "a recording has no band";
  band.points = {2, 3, 1};
  EXPECT_NEAR(*impulse_uncertainty(band, {0, 0.3}), 0.1 * (2 + 3) / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(*peak_uncertainty(band, {0, 0.3}), 3 / std::sqrt(12.0), 1e-12);
  EXPECT_FALSE(impulse_uncertainty(band, {0, 0.5}));
}

}  // namespace
}  // namespace sluice
