#include "solvers/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

namespace sluice {
namespace {

SceneDescription kleefsman(double l0, int layers) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {3.22, 1, 1}};
  d.fluid = {{{1.992, 0, 0}, {3.22, 1, 0.55}}};
  d.obstacles = {{.box = {{0.6635, 0.2985, 0}, {0.8245, 0.7015, 0.161}}}};
  d.particle_distance_m = l0;
  d.wall_layers = layers;
  return d;
}

TEST(Scene, CountsAgreeWithThePapersTable1) {
  const ParticleCounts one_layer = count_particles(kleefsman(0.0075, 1));
  EXPECT_NEAR(static_cast<double>(one_layer.fluid), 1.6e6, 0.03 * 1.6e6);
  EXPECT_NEAR(static_cast<double>(one_layer.solid), 2.1e5, 0.03 * 2.1e5);
  const ParticleCounts three_layers = count_particles(kleefsman(0.0075, 3));
  EXPECT_NEAR(static_cast<double>(three_layers.solid), 6.5e5, 0.03 * 6.5e5);
}

TEST(Scene, FluidVolumeStaysWithinOnePercentAtThePapersDistance) {
  const Scene scene = build_scene(kleefsman(0.0075, 1));
  EXPECT_NEAR(scene.fluid_volume_m3 / scene.nominal_fluid_volume_m3, 1.0, 0.01);
}

TEST(Scene, BuiltParticlesAreAsManyAsCounted) {
  for (const int layers : {1, 3}) {
    const SceneDescription d = kleefsman(0.04, layers);
    const ParticleCounts n = count_particles(d);
    const Scene scene = build_scene(d);
    EXPECT_EQ(n.fluid, static_cast<std::int64_t>(scene.fluid.size()));
    EXPECT_EQ(n.solid, static_cast<std::int64_t>(scene.walls.size()));
  }
}

TEST(Scene, NoLatticeSiteIsUsedTwiceAndTheFirstWallLayerTouchesTheFluidRegion) {
  const double l0 = 0.04;
  const Scene scene = build_scene(kleefsman(l0, 3));
  std::set<std::tuple<long, long, long>> sites;
  const auto site = [&](const Vec3d& p) {
    return std::tuple{std::lround(p.x / l0 - 0.5), std::lround(p.y / l0 - 0.5), std::lround(p.z / l0 - 0.5)};
  };
  for (const Vec3d& p : scene.fluid) EXPECT_TRUE(sites.insert(site(p)).second);
  for (const WallParticle& w : scene.walls) {
    EXPECT_TRUE(sites.insert(site(w.position)).second);
    if (w.body == 0 && w.layer == 0) {
      const bool at_face = std::abs(w.position.z + 0.5 * l0) < 1e-9 || std::abs(w.position.x + 0.5 * l0) < 1e-9 ||
                           std::abs(w.position.y + 0.5 * l0) < 1e-9 ||
                           std::abs(w.position.x - scene.fitted.tank.upper.x - 0.5 * l0) < 1e-9 ||
                           std::abs(w.position.y - scene.fitted.tank.upper.y - 0.5 * l0) < 1e-9;
      EXPECT_TRUE(at_face);
    }
  }
}

TEST(Scene, RecordsEveryFittedLength) {
  const Scene scene = build_scene(kleefsman(0.02, 3));
  std::set<std::string> names;
  for (const FittedLength& f : scene.fitted_lengths) {
    names.insert(f.name);
    EXPECT_LE(std::abs(f.fitted_m - f.nominal_m), 0.02) << f.name;
  }
  EXPECT_EQ(names.count("tank.upper.x"), 0U) << "3.22 m is a multiple of 0.02 m";
  EXPECT_EQ(names.count("obstacle[0].upper.z"), 1U);
  EXPECT_EQ(names.count("fluid[0].upper.z"), 1U);
}

TEST(Scene, CountsWhatNobodyCouldVisit) {
  const ParticleCounts n = count_particles(kleefsman(1e-5, 1));
  EXPECT_NEAR(static_cast<double>(n.fluid) / (1.228 * 0.55 / 1e-15), 1.0, 1e-3);
}

TEST(Scene, AnObstacleThatVanishesIsAnError) {
  try {
    build_scene(kleefsman(0.5, 1));
    FAIL() << "an obstacle of 0.161 m cannot be built at l0 = 0.5 m";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("obstacle[0]"), std::string::npos) << e.what();
  }
}

/// A wall with a gate in it, thinner than three particles.
SceneDescription gate_in_wall(double l0) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {1, 0.4, 0.3}};
  d.fluid = {{{0.6, 0, 0}, {1, 0.4, 0.1}}, {{0, 0, 0}, {0.575, 0.4, 0.02}}};
  const auto plate = [](double y0, double y1) {
    return Obstacle{.box = {{0.575, y0, 0}, {0.6, y1, 0.3}}, .thin = true};
  };
  d.obstacles = {plate(0, 0.1), plate(0.1, 0.3), plate(0.3, 0.4)};
  d.obstacles[1].motion = {{0, 0, 1}, 0, std::numeric_limits<double>::infinity()};
  d.particle_distance_m = l0;
  return d;
}

TEST(Scene, PlatesAreThreeParticlesThickAtLeastAndTakeNoneOfTheFluidsSpaceIfTheyNeedNot) {
  SceneDescription d = gate_in_wall(0.02);
  d.fluid.pop_back();
  const Scene scene = build_scene(d);
  for (const Obstacle& o : scene.fitted.obstacles) {
    EXPECT_NEAR(o.box.lower.x, 0.54, 1e-9);
    EXPECT_NEAR(o.box.upper.x, 0.60, 1e-9);
  }
  EXPECT_NEAR(scene.fluid_volume_m3, 0.4 * 0.4 * 0.1, 1e-9);
  const Scene fine = build_scene(gate_in_wall(0.005));
  EXPECT_NEAR(fine.fitted.obstacles[0].box.lower.x, 0.575, 1e-9) << "five particles: as it is";
}

/// Two cells wide, it would grow into its frame along y.
TEST(Scene, AGateTooNarrowForItsFrameIsRefused) {
  SceneDescription d = gate_in_wall(0.02);
  d.obstacles[0].box.upper.y = d.obstacles[1].box.lower.y = 0.26;
  d.obstacles[1].name = "gate";
  try {
    build_scene(d);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("gate"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("smaller l0"), std::string::npos) << e.what();
  }
}

TEST(Scene, APlateGrowsAwayFromAnotherObstacle) {
  SceneDescription d = gate_in_wall(0.02);
  d.fluid.pop_back();
  d.obstacles.push_back({.box = {{0.4, 0, 0}, {0.56, 0.4, 0.3}}});
  const Scene scene = build_scene(d);
  EXPECT_NEAR(scene.fitted.obstacles[0].box.lower.x, 0.56, 1e-9);
}

TEST(Scene, AGateThatSlidesInItsFrameHasDrySidesAndAWetBottom) {
  const double l0 = 0.02;
  const Scene scene = build_scene(gate_in_wall(l0));
  for (const WallParticle& w : scene.walls) {
    if (w.body != 2) continue;
    const bool in_the_middle = std::abs(w.position.x - 0.57) < 1e-9;
    const bool at_the_bottom = w.position.z < l0;
    EXPECT_EQ(w.layer, in_the_middle && !at_the_bottom ? 1 : 0) << w.position.y << ", " << w.position.z;
  }
  const RigidMotion& motion = scene.fitted.obstacles[1].motion;
  EXPECT_NEAR(motion.stop_s, fluid_ceiling_m(scene.fitted.tank) + 8 * l0, 1e-9) << "out of the fluid's reach";
}

TEST(Scene, CountsThinAndMovingObstaclesAsItBuildsThem) {
  for (const double l0 : {0.02, 0.01, 0.005})
    for (const int layers : {1, 3}) {
      SceneDescription d = gate_in_wall(l0);
      d.wall_layers = layers;
      const Scene scene = build_scene(d);
      const ParticleCounts n = count_particles(d);
      EXPECT_EQ(n.fluid, static_cast<std::int64_t>(scene.fluid.size())) << l0;
      EXPECT_EQ(n.solid, static_cast<std::int64_t>(scene.walls.size())) << l0 << ", layers " << layers;
    }
}

TEST(Scene, KnowsTheStillLevelOverAPoint) {
  const Scene scene = build_scene(gate_in_wall(0.01));
  EXPECT_EQ(scene.still_level_m({0.8, 0.2, 0}, 0), 0.1);
  EXPECT_EQ(scene.still_level_m({0.3, 0.2, 0}, 0), 0.02);
  EXPECT_EQ(scene.still_level_m({0.59, 0.2, 0}, 0), 0) << "in the gate";
  EXPECT_EQ(scene.still_level_m({0.59, 0.2, 0}, 0.03), 0.1) << "the higher of two";
}

TEST(Scene, RejectsParticleDistancesThatAreNoLength) {
  EXPECT_THROW(count_particles(kleefsman(0, 1)), std::invalid_argument);
  EXPECT_THROW(count_particles(kleefsman(-0.01, 1)), std::invalid_argument);
  EXPECT_THROW(count_particles(kleefsman(NAN, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace sluice
