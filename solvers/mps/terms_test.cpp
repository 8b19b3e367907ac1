// The terms one by one, scalar and in packs, against values worked out by hand; the operators on lattices.
#include "solvers/mps/terms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solvers/mps/lattice.h"

namespace sluice::mps {
namespace {

template <class Real>
class MpsTerms : public testing::Test {};
using Paths = testing::Types<double, FloatPack>;
TYPED_TEST_SUITE(MpsTerms, Paths);

double first_lane(double v) {
  return v;
}
double first_lane(FloatPack v) {
  return static_cast<double>(v[0]);
}

TYPED_TEST(MpsTerms, WeightIsHyperbolicAndEndsAtTheEffectiveRadius) {
  using R = TypeParam;
  EXPECT_NEAR(first_lane(weight(R(1), R(2.1F))), 1.1, 1e-6);
  EXPECT_NEAR(first_lane(weight(R(2), R(2.1F))), 0.05, 1e-6);
  EXPECT_EQ(first_lane(weight(R(2.5F), R(2.1F))), 0);
}

TYPED_TEST(MpsTerms, GradientTermPointsToHigherPressure) {
  using R = TypeParam;
  const Vec3<R> r{R(2), R(0), R(0)};
  const auto g = gradient_term(R(1), R(5), r, dot(r, r), R(0.5F));
  EXPECT_NEAR(first_lane(g.x), (5 - 1) * 0.5 / 4 * 2, 1e-6);
  EXPECT_EQ(first_lane(g.y), 0);
}

TYPED_TEST(MpsTerms, CorrectionTermIsTheDyadOfTheDirection) {
  using R = TypeParam;
  const Vec3<R> r{R(3), R(4), R(0)};
  const auto m = correction_term(r, dot(r, r), R(2));
  EXPECT_NEAR(first_lane(m.xx), 2 * 9.0 / 25, 1e-6);
  EXPECT_NEAR(first_lane(m.xy), 2 * 12.0 / 25, 1e-6);
  EXPECT_NEAR(first_lane(m.yy), 2 * 16.0 / 25, 1e-6);
  EXPECT_EQ(first_lane(m.zz), 0);
}

TYPED_TEST(MpsTerms, RelaxationGrowsWithTheCrowdingBeyondTheToleratedOne) {
  using R = TypeParam;
  for (const float below : {-0.5F, 0.0F, 0.15F})
    EXPECT_NEAR(first_lane(relaxation(R(below), R(0.01F), R(0.15F))), 0.01, 1e-8);
  EXPECT_NEAR(first_lane(relaxation(R(0.4F), R(0.01F), R(0.15F))), 0.26, 1e-7);
}

TYPED_TEST(MpsTerms, CollisionTurnsAnApproachRoundWithItsRestitution) {
  using R = TypeParam;
  const Vec3<R> r{R(0.1F), R(0), R(0)};
  const Vec3<R> approach{R(-2), R(7), R(0)};  // u_j - u_i: j comes towards i at 2 m/s
  const auto du = collision_term(approach, r, R(0.2F), R(0.5F));
  // Both change by half of (1 + e) times the approach: they part at e times the speed of approach.
  EXPECT_NEAR(first_lane(du.x), -1.2, 1e-6);
  EXPECT_NEAR(first_lane(du.y), 0, 1e-6);
  const Vec3<R> parting{R(2), R(0), R(0)};
  EXPECT_EQ(first_lane(collision_term(parting, r, R(0.2F), R(0.5F)).x), 0);
}

TEST(MpsLattice, NumberDensityOfTheFullLattice) {
  const LatticeConstants c = lattice_constants(0.02, 0.042, 0.034);
  EXPECT_NEAR(c.number_density, 14.4186, 5e-5);
  // lambda0 is the weights' mean square distance; between the nearest neighbour's and the farthest's.
  EXPECT_GT(c.lambda_m2, 0.02 * 0.02);
  EXPECT_LT(c.lambda_m2, 0.042 * 0.042);
}

TEST(MpsSolve, SymmetricSystemOfThree) {
  const Symmetric3<double> m{4, 5, 6, 1, 0.5, -1};
  const Vec3d x{1, -2, 3};
  const Vec3d v{4 * x.x + x.y + 0.5 * x.z, x.x + 5 * x.y - x.z, 0.5 * x.x - x.y + 6 * x.z};
  Vec3d found;
  ASSERT_TRUE(solve(m, v, 5.0, 0.01, found));
  EXPECT_NEAR(found.x, x.x, 1e-12);
  EXPECT_NEAR(found.y, x.y, 1e-12);
  EXPECT_NEAR(found.z, x.z, 1e-12);
}

TEST(MpsSolve, RefusesAMatrixOfNeighboursInAPlane) {
  const Symmetric3<double> flat{5, 5, 0, 0, 0, 0};
  Vec3d untouched{7, 7, 7};
  EXPECT_FALSE(solve(flat, {1, 1, 0}, 5.0, 0.01, untouched));
  EXPECT_EQ(untouched.x, 7);
}

}  // namespace
}  // namespace sluice::mps
