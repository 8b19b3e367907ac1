// The solver on a few particles: signs, agreement of the fast path with the reference, independence of threads, losses.
#include "solvers/wcsph/wcsph_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solvers/memory_archive.h"
#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/test_tank.h"

namespace sluice::wcsph {
namespace {

constexpr double l0 = 0.02;

template <class Pack>
class Solvers : public testing::Test {};
using Paths = testing::Types<double, FloatPack>;
TYPED_TEST_SUITE(Solvers, Paths);

template <class Pack>
std::size_t index_of(const WcsphSolver<Pack>& s, std::int32_t id) {
  return static_cast<std::size_t>(std::find(s.fluid().id.begin(), s.fluid().id.end(), id) - s.fluid().id.begin());
}

/// Two particles l0 apart along x in the middle of nowhere.
template <class Pack>
WcsphSolver<Pack> two_particles() {
  return WcsphSolver<Pack>(free_particles(l0, {{0.4, 0.4, 0.4}, {0.4 + l0, 0.4, 0.4}}), free_parameters(l0), 1);
}

TYPED_TEST(Solvers, TwoThatApproachGainDensityAndAreSlowedDown) {
  auto s = two_particles<TypeParam>();
  s.set_fluid(0, {0.5, 0, 0}, 0);
  s.set_fluid(1, {-0.5, 0, 0}, 0);
  s.step();
  EXPECT_GT(s.fluid().density[0], 0);
  EXPECT_GT(s.fluid().density[1], 0);
  EXPECT_LT(s.fluid().velocity.x[index_of(s, 0)], 0.5) << "viscosity acts against the approach";
  EXPECT_GT(s.fluid().velocity.x[index_of(s, 1)], -0.5);
}

TYPED_TEST(Solvers, TwoThatPartLoseDensityWithoutViscousForce) {
  auto s = two_particles<TypeParam>();
  s.set_fluid(0, {-0.5, 0, 0}, 0);
  s.set_fluid(1, {0.5, 0, 0}, 0);
  s.step();
  EXPECT_LT(s.fluid().density[0], 0);
  EXPECT_EQ(s.fluid().velocity.x[index_of(s, 0)], typename Lanes<TypeParam>::Real(-0.5));
}

TYPED_TEST(Solvers, TwoUnderPressureAreDrivenApart) {
  auto s = two_particles<TypeParam>();
  s.set_fluid(0, {0, 0, 0}, 2);
  s.set_fluid(1, {0, 0, 0}, 2);
  s.step();
  EXPECT_LT(s.fluid().velocity.x[index_of(s, 0)], 0);
  EXPECT_GT(s.fluid().velocity.x[index_of(s, 1)], 0);
}

TYPED_TEST(Solvers, FluidInTensionPullsNoHarderThanTheLimit) {
  const auto pull_m_s2 = [](double tension_limit) {
    Parameters p = free_parameters(l0);
    p.tension_limit = tension_limit;
    WcsphSolver<TypeParam> s(free_particles(l0, {{0.4, 0.4, 0.4}, {0.4 + l0, 0.4, 0.4}}), p, 1);
    s.set_fluid(0, {0, 0, 0}, -100);
    s.set_fluid(1, {0, 0, 0}, -100);
    const double dt_s = s.step();
    return static_cast<double>(s.fluid().velocity.x[index_of(s, 0)]) / dt_s;
  };
  const double c0 = free_parameters(l0).speed_of_sound_m_s;
  EXPECT_GT(pull_m_s2(1), 0) << "the paper's, which has no limit";
  EXPECT_NEAR(pull_m_s2(0.01) / pull_m_s2(1), -0.01 * 1000 * c0 * c0 / tait_pressure(-100.0, Tait{1000, c0}), 1e-5);
  EXPECT_EQ(pull_m_s2(0), 0);
}

TYPED_TEST(Solvers, NoneIsThinnerThanOneThatIsAlone) {
  auto s = two_particles<TypeParam>();
  s.set_fluid(0, {-40, 0, 0}, -850);
  s.set_fluid(1, {40, 0, 0}, -850);
  for (int k = 0; k < 20; ++k) s.step();
  const double h = s.smoothing_length_m();
  EXPECT_NEAR(1000 + static_cast<double>(s.fluid().density[0]), 1000 * l0 * l0 * l0 * Wendland{h}.normalisation(),
              0.01);
}

TYPED_TEST(Solvers, DensityDiffusesBetweenTwo) {
  auto s = two_particles<TypeParam>();
  s.set_fluid(0, {0, 0, 0}, 4);
  s.set_fluid(1, {0, 0, 0}, 0);
  s.step();
  EXPECT_LT(s.fluid().density[index_of(s, 0)], 4);
  EXPECT_GT(s.fluid().density[index_of(s, 1)], 0);
}

TYPED_TEST(Solvers, AnIsolatedDropKeepsItsMomentum) {
  std::vector<Vec3d> drop;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.2 * l0, 0.2 * l0);
  for (int k = 0; k < 512; ++k) {
    drop.push_back({0.3 + (k % 8) * l0 + jitter(random), 0.3 + (k / 8 % 8) * l0 + jitter(random),
                    0.3 + (k / 64) * l0 + jitter(random)});
  }
  WcsphSolver<TypeParam> s(free_particles(l0, drop), free_parameters(l0), 2);
  for (std::int32_t k = 0; k < 512; ++k)
    s.set_fluid(k, {0.3 + 20 * jitter(random), 10 * jitter(random), -0.2}, 100 * jitter(random));
  const auto momentum = [&] {
    Vec3d sum;
    double size = 0;
    for (std::size_t i = 0; i < s.fluid().n; ++i) {
      const Vec3d u = s.fluid().velocity.template at<double>(i);
      sum += u;
      size += std::sqrt(dot(u, u));
    }
    return std::pair{sum, size};
  };
  const Vec3d before = momentum().first;
  for (int k = 0; k < 100; ++k) s.step();
  const auto [after, size] = momentum();
  const Vec3d change = after - before;
  EXPECT_LT(std::sqrt(dot(change, change)) / size, sizeof(typename Lanes<TypeParam>::Real) == 8 ? 1e-12 : 1e-5);
  EXPECT_EQ(s.fluid_count(), 512);
}

class Walls : public testing::TestWithParam<WallModel> {};
INSTANTIATE_TEST_SUITE_P(Both, Walls, testing::Values(WallModel::dynamic, WallModel::extrapolated),
                         [](const auto& info) {
                           return info.param == WallModel::dynamic ? "dynamic" : "extrapolated";
                         });

TEST_P(Walls, FastPathFollowsTheReference) {
  const Scene scene = small_dam_break(GetParam());
  WcsphSolver<double> reference(scene, small_parameters(scene, GetParam()), 1);
  WcsphSolver<FloatPack> fast(scene, small_parameters(scene, GetParam()), 1);
  for (int k = 0; k < 150; ++k) {
    reference.step();
    fast.step();
  }
  EXPECT_NEAR(fast.time_s() / reference.time_s(), 1.0, 1e-5);
  double worst = 0;
  double worst_pressure = 0;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(scene.fluid.size()); ++id) {
    const std::size_t a = index_of(reference, id);
    const std::size_t b = index_of(fast, id);
    const Vec3d d = reference.fluid().position.at<double>(a) - fast.fluid().position.at<double>(b);
    worst = std::max(worst, std::sqrt(dot(d, d)));
    worst_pressure = std::max(worst_pressure,
                              std::abs(reference.fluid().pressure[a] - static_cast<double>(fast.fluid().pressure[b])));
  }
  EXPECT_LT(worst, 2e-4 * l0);
  EXPECT_LT(worst_pressure, 0.01 * 1000 * 9.81 * 0.24);
}

TEST_P(Walls, ResultsAreBitwiseEqualForAnyNumberOfThreads) {
  const Scene scene = small_dam_break(GetParam(), 2);
  const Parameters p = small_parameters(scene, GetParam());
  WcsphSolver<FloatPack> one(scene, p, 1);
  WcsphSolver<FloatPack> two(scene, p, 2);
  WcsphSolver<FloatPack> four(scene, p, 4);
  while (one.time_s() < 0.12) {
    one.step();
    two.step();
    four.step();
  }
  for (const auto* other : {&two, &four}) {
    ASSERT_EQ(one.time_s(), other->time_s());
    EXPECT_EQ(one.fluid().id, other->fluid().id);
    EXPECT_EQ(one.fluid().position.x, other->fluid().position.x);
    EXPECT_EQ(one.fluid().position.y, other->fluid().position.y);
    EXPECT_EQ(one.fluid().position.z, other->fluid().position.z);
    EXPECT_EQ(one.fluid().velocity.x, other->fluid().velocity.x);
    EXPECT_EQ(one.fluid().density, other->fluid().density);
    EXPECT_EQ(one.walls().density, other->walls().density);
  }
}

/// At several steps, since some sort and most do not, and some restart the Verlet scheme.
TEST_P(Walls, GoesOnFromASavedStateBitForBit) {
  const Scene scene = small_dam_break(GetParam());
  const Parameters p = small_parameters(scene, GetParam());
  WcsphSolver<FloatPack> straight(scene, p, 2);
  while (straight.steps() < 200) straight.step();
  for (const int saved_after : {140, 159, 181}) {
    WcsphSolver<FloatPack> first(scene, p, 2);
    while (first.steps() < saved_after) first.step();
    MemoryArchive archive;
    first.visit_state(archive);
    archive.rewind();
    WcsphSolver<FloatPack> second(scene, p, 1);
    second.visit_state(archive);
    const Vec3d behind{0.8, 0.1, 0.02};
    const Vec3d under_water{0.7, 0.1, 0.1};
    EXPECT_GT(first.wall_pressure(behind).pressure_Pa, 500);
    EXPECT_EQ(second.wall_pressure(behind).pressure_Pa, first.wall_pressure(behind).pressure_Pa);
    EXPECT_GT(first.volume_fraction(under_water), 0.5);
    EXPECT_EQ(second.volume_fraction(under_water), first.volume_fraction(under_water));
    while (second.steps() < 200) second.step();
    ASSERT_EQ(straight.time_s(), second.time_s()) << saved_after;
    EXPECT_EQ(straight.fluid().position.x, second.fluid().position.x) << saved_after;
    EXPECT_EQ(straight.fluid().density, second.fluid().density) << saved_after;
    EXPECT_EQ(straight.walls().density, second.walls().density) << saved_after;
    EXPECT_EQ(straight.facts(), second.facts()) << saved_after;
  }
}

/// A particle that is held at every step, at a wall that has no particles of its own, falls along it freely.
TYPED_TEST(Solvers, OneThatIsHeldAtAWallSlidesAlongIt) {
  SceneDescription d = still_tank(l0, 20 * l0, 20 * l0, 60 * l0, 4 * l0, WallModel::extrapolated);
  d.gravity_m_s2 = {-5, 0, -9.81};
  Scene scene = build_scene(d);
  scene.fluid = {{-0.6 * l0, 10 * l0, 40 * l0}};
  scene.walls.clear();
  Parameters p = parameters_for(d, 4 * l0, WallModel::extrapolated);
  p.alpha = 0;
  p.water_height_m = -1;
  WcsphSolver<TypeParam> s(scene, p, 1);
  while (s.steps() < 100) s.step();
  EXPECT_GT(s.facts().at("held_at_walls"), 90);
  EXPECT_GE(s.fluid().position.template at<double>(0).x, -0.5 * l0 - 1e-9);
  EXPECT_NEAR(static_cast<double>(s.fluid().velocity.z[0]) / (-9.81 * s.time_s()), 1, 1e-5);
}

TEST(WcsphSolver, WalledInFluidIsNotLost) {
  const Scene scene = small_dam_break(WallModel::extrapolated);
  WcsphSolver<FloatPack> s(scene, small_parameters(scene, WallModel::extrapolated), 2);
  while (s.time_s() < 0.45) s.step();
  EXPECT_EQ(s.lost().through_walls, 0);
  EXPECT_EQ(s.fluid_count() + s.lost().over_top, static_cast<std::int64_t>(scene.fluid.size()));
}

TEST(WcsphSolver, StartsHydrostaticallyWhereverTheFloorIs) {
  const auto greatest_pressure = [](double floor_m) {
    SceneDescription d = still_tank(0.02, 0.4, 0.2, 0.4, 0.2, WallModel::extrapolated);
    for (Box* box : {&d.tank, &d.fluid[0]}) *box = shifted(*box, {0, 0, floor_m});
    WcsphSolver<FloatPack> s(build_scene(d), parameters_for(d, 0.2, WallModel::extrapolated), 1);
    const std::vector<float> p = s.snapshot().pressure_Pa;
    return *std::max_element(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(s.fluid_count()));
  };
  EXPECT_NEAR(greatest_pressure(0), 1000 * 9.81 * 0.19, 1);
  EXPECT_NEAR(greatest_pressure(1), greatest_pressure(0), 1);
}

TEST(WcsphSolver, CountsParticlesThatPassThroughAWallApartFromThoseOverTheTop) {
  // One shot at a wall faster than it can be held, one upwards out of the tank.
  WcsphSolver<FloatPack> s(free_particles(l0, {{0.1, 0.4, 0.4}, {0.6, 0.4, 0.6}}), free_parameters(l0), 1);
  s.set_fluid(0, {-400, 0, 0}, 0);
  s.set_fluid(1, {0, 0, 400}, 0);
  for (int k = 0; k < 200 && s.fluid_count() > 0; ++k) s.step();
  EXPECT_EQ(s.lost().through_walls, 1);
  EXPECT_EQ(s.lost().over_top, 1);
  EXPECT_EQ(s.fluid_count(), 0);
}

TEST(WcsphSolver, StaysWithinItsMemory) {
  const Scene scene = build_scene(still_tank(0.02, 0.8, 0.4, 0.4, 0.3, WallModel::extrapolated));
  WcsphSolver<FloatPack> s(scene, parameters_for(scene.description, 0.3, WallModel::extrapolated), 2);
  while (s.steps() < 10) s.step();
  EXPECT_LE(s.memory_bytes(), 200 * (s.fluid_count() + s.solid_count()));
}

TEST(WcsphSolver, NamesAParameterThatIsOutOfRange) {
  const Scene scene = small_dam_break(WallModel::dynamic);
  Parameters p = small_parameters(scene, WallModel::dynamic);
  p.courant = -1;
  try {
    WcsphSolver<FloatPack> s(scene, p, 1);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("courant"), std::string::npos);
  }
}

TEST(WcsphSolver, SaysThatItHasBecomeUnstable) {
  auto s = two_particles<FloatPack>();
  s.set_fluid(0, {NAN, 0, 0}, 0);
  EXPECT_THROW(
      {
        for (int k = 0; k < 3; ++k) s.step();
      },
      std::runtime_error);
}

TEST(FixedPoint, PairDifferencesAreExactToANanometreAnywhereInTheTank) {
  const FixedPoint<std::int32_t> x(-0.08, 3.4);
  const double quantum = FixedPoint<std::int32_t>::quantum_m(3.4);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(0.0, 3.2);
  std::uniform_real_distribution<double> near(-0.02, 0.02);
  for (int k = 0; k < 1000; ++k) {
    const double a = in(random);
    const double b = a + near(random);
    EXPECT_NEAR((x.encode(b) - x.encode(a)) * quantum, b - a, 1e-9);
  }
}

}  // namespace
}  // namespace sluice::wcsph
