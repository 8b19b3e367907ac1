#include "solvers/tank.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

constexpr double l0 = 0.02;

/// A tank with a block that stands on its floor, one that hangs in it, and one that hangs and will rise.
Tank tank_with_bodies() {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {1, 1, 0.4}};
  d.fluid = {{{0.8, 0, 0}, {1, 1, 0.1}}};
  d.obstacles = {{.box = {{0.2, 0.2, 0}, {0.4, 0.4, 0.2}}},
                 {.box = {{0.6, 0.4, 0.1}, {0.8, 0.6, 0.2}}},
                 {.box = {{0.2, 0.6, 0.1}, {0.4, 0.8, 0.2}}, .motion = {.velocity_m_s = {0, 0, 1}, .stop_s = 1}}};
  d.particle_distance_m = l0;
  return Tank(build_scene(d));
}

TEST(Tank, WhatRunsIntoAWallIsSetBackAndKeepsItsVelocityAlongIt) {
  const Tank tank = tank_with_bodies();
  Vec3d x{-0.015, 0.5, 0.1};
  Vec3d u{-1, 2, 3};
  EXPECT_TRUE(tank.hold(x, u));
  EXPECT_DOUBLE_EQ(x.x, -0.01);
  EXPECT_DOUBLE_EQ(u.x, 0);
  EXPECT_DOUBLE_EQ(u.y, 2);
  Vec3d inside{0.6, 0.5, 0.1};
  EXPECT_FALSE(tank.hold(inside, u));
}

/// Half a particle distance in the floor is where the floor holds a particle; from there it crept under the block.
TEST(Tank, NothingCreepsBetweenTheFloorAndABlockThatStandsOnIt) {
  const Tank tank = tank_with_bodies();
  Vec3d x{0.389, 0.3, -0.5 * l0};
  Vec3d u{-1, 0, 0};
  EXPECT_TRUE(tank.hold(x, u));
  EXPECT_DOUBLE_EQ(x.x, 0.4 - 0.5 * l0);
  EXPECT_DOUBLE_EQ(u.x, 0);
  EXPECT_EQ(tank.whereabouts(x), Whereabouts::inside);
}

TEST(Tank, ABodyThatMovesPushesAtItsOwnSpeedAndHasABottom) {
  Tank tank = tank_with_bodies();
  tank.move_obstacles(0.1);
  Vec3d x{0.3, 0.7, 0.2 + 0.015};
  Vec3d u{0, 0, 2};
  EXPECT_TRUE(tank.hold(x, u));
  EXPECT_DOUBLE_EQ(x.z, 0.2 + 0.5 * l0);
  EXPECT_DOUBLE_EQ(u.z, 1);
}

/// 0.1 - 0.6 + 0.6 is not 0.1: where the body takes nothing, the velocity stays what it was, to the last digit.
TEST(Tank, ABodyThatMovesLeavesTheVelocityAlongItAsItIs) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {1, 1, 0.4}};
  d.obstacles = {{.box = {{0.2, 0.6, 0.1}, {0.4, 0.8, 0.2}}, .motion = {.velocity_m_s = {0, 0, 0.6}, .stop_s = 1}}};
  d.particle_distance_m = l0;
  const Tank tank(build_scene(d));
  for (int k = 0; k < 1000; ++k) {
    Vec3d x{0.2 + 0.75 * l0, 0.7, 0.15};
    Vec3d u{1, -0.5, static_cast<double>(static_cast<float>(-1.3 + 1e-3 * k))};
    const Vec3d before = u;
    ASSERT_TRUE(tank.hold(x, u));
    EXPECT_EQ(u.x, 0);
    EXPECT_EQ(u.y, before.y);
    EXPECT_EQ(u.z, before.z);
  }
}

TEST(Tank, ABodyAsHighAsTheTankHasATopThatSplashesFallOn) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {1, 1, 0.4}};
  d.obstacles = {{.box = {{0.2, 0.2, 0}, {0.4, 0.4, 0.4}}}};
  d.particle_distance_m = l0;
  const Tank tank(build_scene(d));
  EXPECT_EQ(tank.whereabouts({0.3, 0.3, 0.4 + 0.5 * l0}), Whereabouts::inside);
  EXPECT_EQ(tank.whereabouts({0.3, 0.3, 0.4 - 1.5 * l0}), Whereabouts::through_wall);
  Vec3d x{0.3, 0.3, 0.4 - 0.75 * l0};
  Vec3d u{1, 0, -2};
  EXPECT_TRUE(tank.hold(x, u));
  EXPECT_DOUBLE_EQ(x.z, 0.4 - 0.5 * l0);
  EXPECT_EQ(u.z, 0);
}

TEST(Tank, WhatRisesAgainstABodyThatHangsStaysUnderIt) {
  const Tank tank = tank_with_bodies();
  Vec3d x{0.7, 0.5, 0.1 + 0.75 * l0};
  Vec3d u{1, 0, 2};
  EXPECT_TRUE(tank.hold(x, u));
  EXPECT_DOUBLE_EQ(x.z, 0.1 + 0.5 * l0);
  EXPECT_DOUBLE_EQ(u.z, 0);
  EXPECT_DOUBLE_EQ(u.x, 1);
}

TEST(Tank, TellsWhichWayAParticleLeft) {
  const Tank tank = tank_with_bodies();
  EXPECT_EQ(tank.whereabouts({0.6, 0.5, 0.1}), Whereabouts::inside);
  EXPECT_EQ(tank.whereabouts({0.6, 0.5, -1.1 * l0}), Whereabouts::through_wall);
  EXPECT_EQ(tank.whereabouts({0.3, 0.3, 0.1}), Whereabouts::through_wall);
  EXPECT_EQ(tank.whereabouts({-1.1 * l0, 0.5, 0.39}), Whereabouts::over_top);
  EXPECT_EQ(tank.whereabouts({0.0 / 0.0, 0.5, 0.1}), Whereabouts::undefined);
}

}  // namespace
}  // namespace sluice
