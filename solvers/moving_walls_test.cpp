// Bodies that move as prescribed, in both solvers: a gate that holds water back, and one that is lifted.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "solvers/memory_archive.h"
#include "solvers/mps/collisions.h"
#include "solvers/mps/mps_solver.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice {
namespace {

constexpr double l0 = 0.02;
constexpr double depth_m = 0.12;

/// A gate across the whole tank, with water on one side of it.
SceneDescription gated_tank(double start_s, int layers) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {0.6, 0.08, 0.24}};
  d.fluid = {{{0, 0, 0}, {0.24, 0.08, depth_m}}};
  Obstacle gate{.box = {{0.24, 0, 0}, {0.25, 0.08, 0.24}}, .name = "gate", .thin = true};
  gate.motion = {{0, 0, 1.25}, start_s, std::numeric_limits<double>::infinity()};
  d.obstacles = {gate};
  d.particle_distance_m = l0;
  d.wall_layers = layers;
  return d;
}

std::unique_ptr<Solver> make(const std::string& solver, const Scene& scene, int threads) {
  if (solver == "mps") {
    mps::Parameters p;
    p.particle_distance_m = l0;
    p.greatest_speed_m_s = 2.5;
    p.gravity_m_s2 = scene.description.gravity_m_s2;
    return make_mps_solver(scene, p, threads);
  }
  wcsph::Parameters p;
  p.particle_distance_m = l0;
  p.water_height_m = depth_m;
  p.gravity_m_s2 = scene.description.gravity_m_s2;
  p.speed_of_sound_m_s = 10 * std::sqrt(9.81 * depth_m);
  p.wall_friction = 0;
  p.walls = solver == "wcsph-dynamic" ? wcsph::WallModel::dynamic : wcsph::WallModel::extrapolated;
  return make_wcsph_solver(scene, p, threads);
}

Scene scene_for(const std::string& solver, double start_s) {
  return build_scene(gated_tank(start_s, solver == "wcsph-dynamic" ? 1 : 3));
}

float front_m(const Solver& solver) {
  const ParticleSnapshot s = solver.snapshot();
  float front = 0;
  for (std::size_t i = 0; i < s.fluid_count; ++i) front = std::max(front, s.position_m[i].x);
  return front;
}

/// Lowest particle of the gate.
float gate_bottom_m(const Solver& solver, const Scene& scene) {
  const ParticleSnapshot s = solver.snapshot();
  float lowest = 1e9F;
  for (std::size_t i = s.fluid_count; i < s.position_m.size(); ++i) {
    const auto wall = static_cast<std::size_t>(s.id[i]) - scene.fluid.size();
    if (scene.walls[wall].body == 1) lowest = std::min(lowest, s.position_m[i].z);
  }
  return lowest;
}

void run_to(Solver& solver, double t_s) {
  while (solver.time_s() < t_s) solver.step();
}

class Gate : public ::testing::TestWithParam<std::string> {};

TEST_P(Gate, IsMadeThreeParticlesThickOnTheDrySide) {
  const Scene scene = scene_for(GetParam(), 0);
  const Box& gate = scene.fitted.obstacles[0].box;
  EXPECT_NEAR(gate.lower.x, 0.24, 1e-9);
  EXPECT_NEAR(gate.upper.x, 0.30, 1e-9);
  EXPECT_NEAR(scene.fluid_volume_m3, scene.nominal_fluid_volume_m3, 1e-9);
}

TEST_P(Gate, HoldsTheWaterWhileItIsShut) {
  const Scene scene = scene_for(GetParam(), 10);
  const auto solver = make(GetParam(), scene, 1);
  run_to(*solver, 0.3);
  EXPECT_LT(front_m(*solver), 0.24 + 0.2 * l0);
  EXPECT_EQ(solver->fluid_count(), static_cast<std::int64_t>(scene.fluid.size()));
}

TEST_P(Gate, LetsTheWaterRunOutAndLeaves) {
  const Scene scene = scene_for(GetParam(), 0.05);
  const auto solver = make(GetParam(), scene, 1);
  run_to(*solver, 0.15);
  EXPECT_NEAR(gate_bottom_m(*solver, scene), 0.5 * l0 + 1.25 * (solver->time_s() - 0.05), 1e-5);
  run_to(*solver, 0.6);
  EXPECT_GT(front_m(*solver), 0.5F) << "the front of the dam break";
  const float out_m = gate_bottom_m(*solver, scene);
  EXPECT_GT(out_m, fluid_ceiling_m(scene.fitted.tank) + 6 * l0) << "beyond the reach of any fluid";
  run_to(*solver, 0.65);
  EXPECT_EQ(gate_bottom_m(*solver, scene), out_m) << "where it stays";
  EXPECT_EQ(solver->lost().through_walls, 0);
}

/// Stopped at a time and taken up on another number of threads, the solver computes what it does in one go.
void expect_the_same_after_a_restart(const std::string& name, const Scene& scene, double stop_s) {
  const auto whole = make(name, scene, 1);
  const auto first = make(name, scene, 1);
  const auto second = make(name, scene, 2);
  run_to(*whole, stop_s);
  run_to(*first, stop_s);
  MemoryArchive archive;
  first->visit_state(archive);
  archive.rewind();
  second->visit_state(archive);
  for (int k = 0; k < 40; ++k) {
    whole->step();
    second->step();
  }
  const ParticleSnapshot a = whole->snapshot();
  const ParticleSnapshot b = second->snapshot();
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.velocity_m_s, b.velocity_m_s);
  EXPECT_EQ(a.pressure_Pa, b.pressure_Pa);
}

TEST_P(Gate, GoesOnBitForBitAfterARestartOnItsWay) {
  expect_the_same_after_a_restart(GetParam(), scene_for(GetParam(), 0.02), 0.1);
}

TEST_P(Gate, GoesOnBitForBitAfterARestartWhereItStarts) {
  const auto shut = make(GetParam(), scene_for(GetParam(), 10), 1);
  run_to(*shut, 0.02);
  const double end_of_a_step_s = shut->time_s();
  expect_the_same_after_a_restart(GetParam(), scene_for(GetParam(), end_of_a_step_s), end_of_a_step_s);
}

/// In MPS, normals are found anew around what moves alone: they have to be those of a search everywhere.
TEST(MovingWalls, NormalsOfWallsAreThoseOfWhereTheGateIs) {
  const Scene scene = scene_for("mps", 0.01);
  const auto made = make("mps", scene, 2);
  auto& solver = dynamic_cast<mps::MpsSolver<FloatPack>&>(*made);
  const Vec3d at_first = solver.normals_of_walls().at<double>(0);
  EXPECT_NEAR(dot(at_first, at_first), 1, 1e-12);
  for (const double t_s : {0.005, 0.05, 0.15, 0.4}) {
    run_to(solver, t_s);
    const auto& particles = solver.particles();
    std::vector<std::int8_t> moving_body;
    for (std::size_t w = 0; w < particles.walls; ++w) {
      const auto wall = static_cast<std::size_t>(particles.id[particles.first_wall() + w]) - scene.fluid.size();
      moving_body.push_back(static_cast<std::int8_t>(scene.walls[wall].body));
    }
    VectorField<double> everywhere;
    everywhere.resize(particles.walls);
    const Box all{{-10, -10, -10}, {10, 10, 10}};
    mps::find_wall_normals(particles, {solver.dummy_set().index, solver.wall_set().index, moving_body}, l0, all, 1,
                           everywhere);
    EXPECT_EQ(everywhere.x, solver.normals_of_walls().x) << "at " << t_s << " s";
    EXPECT_EQ(everywhere.y, solver.normals_of_walls().y);
    EXPECT_EQ(everywhere.z, solver.normals_of_walls().z);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, Gate, ::testing::Values("wcsph", "wcsph-dynamic", "mps"), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// A plate that runs into a single particle at rest, which has no pressure: spray.
TEST(Piston, PushesALoneParticleAheadOfItself) {
  for (const std::string name : {"wcsph", "mps"}) {
    SceneDescription d = gated_tank(0, 3);
    d.gravity_m_s2 = {0, 0, 0};
    d.fluid = {{{0.30, 0.02, 0.04}, {0.32, 0.04, 0.06}}};
    d.obstacles = {Obstacle{.box = {{0.16, 0, 0}, {0.24, 0.08, 0.12}}, .name = "plate"}};
    d.obstacles[0].motion = {{0.5, 0, 0}, 0, 0.4};
    const Scene scene = build_scene(d);
    ASSERT_EQ(scene.fluid.size(), 1U);
    const auto solver = make(name, scene, 1);
    run_to(*solver, 0.4);
    EXPECT_EQ(solver->lost().through_walls, 0) << name;
    EXPECT_GT(front_m(*solver), 0.44 - 0.5 * l0) << name;
  }
}

TEST(RigidMotion, StartsAndStops) {
  const RigidMotion m{{0, 0, 2}, 1, 3};
  EXPECT_EQ(m.displacement_m(0.5), (Vec3d{0, 0, 0}));
  EXPECT_EQ(m.displacement_m(2), (Vec3d{0, 0, 2}));
  EXPECT_EQ(m.displacement_m(9), (Vec3d{0, 0, 4}));
  EXPECT_EQ(m.velocity_at(0.99), (Vec3d{0, 0, 0}));
  EXPECT_EQ(m.velocity_at(1), (Vec3d{0, 0, 2}));
  EXPECT_EQ(m.velocity_at(3), (Vec3d{0, 0, 0}));
}

TEST(Scene, ABodyThatMovesSidewaysForEverIsAnError) {
  SceneDescription d = gated_tank(0, 3);
  d.obstacles[0].motion.velocity_m_s = {1, 0, 0};
  EXPECT_THROW(build_scene(d), std::invalid_argument);
}

}  // namespace
}  // namespace sluice
