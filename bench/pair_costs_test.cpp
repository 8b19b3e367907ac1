#include "bench/pair_costs.h"

#include <gtest/gtest.h>

#include "bench/operation_count.h"

namespace sluice {
namespace {

TEST(OperationCount, CountsEachOperationOnce) {
  const CountingReal a(3);
  const CountingReal b(2);
  EXPECT_EQ(count_operations([&] { EXPECT_EQ((a * b + a - b / a).value, 9 - 2.0 / 3); }), 4);
  EXPECT_EQ(count_operations([&] { EXPECT_EQ(larger(square_root(a), -b).value, std::sqrt(3)); }), 2);
  EXPECT_EQ(count_operations([] {}), 0);
}

// Counted by hand from the formulas: distance 3 + 5, root and taper 1 + 3; for both, g 2, relative velocity and
// approach 3 + 5.
TEST(PairCosts, AreThoseOfTheFormulas) {
  EXPECT_EQ(bench::operations_of_wall_continuity(), 12 + 2 + 8 + 1 + 1);
  // viscosity: densities and speeds 2, quotient 3, mu 1, Pi 2, largest mu 2; pressure 1, force 6, momentum 3
  const double terms = 12 + 2 + 8 + 10 + 1 + 6 + 3;
  EXPECT_EQ(bench::operations_of_fluid_and_wall(), terms + 3 + 2);
  // both momenta 6, continuity 2, diffusion 4, and the other's rate: diffusion 3, factors and sums 4
  EXPECT_EQ(bench::operations_of_fluid_pair(), terms + 6 + 2 + 4 + 3 + 4);
  EXPECT_EQ(bench::operations_of_extrapolated_pressure(), 12 + 6 + 1 + 1 + 7 + 2);
  EXPECT_EQ(bench::operations_of_listed_neighbour(), 3 + 5 + 1 + 3 + 1 + 6);
  EXPECT_EQ(bench::operations_of_viscosity_term(), 3 + 5 + 1 + 3 + 6 + 3);
  EXPECT_EQ(bench::operations_of_collision_test(), 3 + 3 + 6 + 5);
}

TEST(PairCosts, GradientAndItsCorrection) {
  // least pressure 1, distance 8, term 3 + 3 + 3, matrix 1 + 12 + 6
  EXPECT_EQ(bench::operations_of_gradient_term(), 1 + 8 + 9 + 19);
}

}  // namespace
}  // namespace sluice
