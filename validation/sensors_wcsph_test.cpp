// The sensors on the real solver: a still tank with a box under water, whose readings are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "solvers/wcsph/wcsph_solver.h"
#include "validation/case.h"
#include "validation/sensors.h"

namespace sluice {
namespace {

constexpr double level = 0.24;
constexpr double weight = 1000 * 9.81;  // of a cubic metre of water [N]

// Lengths that the lattice must fit: the box's face 0.205 becomes 0.20, its top 0.095 becomes 0.10.
Case still_tank() {
  Case c;
  c.tank = {{0, 0, 0}, {0.6, 0.4, 0.4}};
  c.fluid = {{{0, 0, 0}, {0.6, 0.4, level}}};
  c.obstacles = {{.box = {{0.0, 0.1, 0}, {0.205, 0.3, 0.095}}}};
  c.gravity_m_s2 = {0, 0, -9.81};
  c.water_height_m = level;
  c.density_kg_m3 = 1000;
  c.sensors = {{"H1", SensorKind::wave_height, {0.41, 0.21, 0}, {0, 0, 1}, ""},
               {"H2", SensorKind::wave_height, {0.103, 0.2, 0.095}, {0, 0, 1}, ""},
               {"P1", SensorKind::pressure, {0.205, 0.2, 0.06}, {1, 0, 0}, ""},
               {"P2", SensorKind::pressure, {0.1, 0.2, 0.095}, {0, 0, 1}, ""},
               {"P3", SensorKind::pressure, {0.6, 0.2, 0.14}, {-1, 0, 0}, ""}};
  c.solvers = {
      {"wcsph", "extrapolated", {{"extrapolated", 3, "wall", "column"}, {"dynamic", 1, "kernel", "column"}}, {}}};
  return c;
}

// Readings at rest, by column, after the first step of one kind of walls.
std::map<std::string, double> readings(const std::string& walls, wcsph::WallModel model, double l0) {
  const Case c = still_tank();
  const Scene scene = build_scene(scene_description(c, l0, find_walls(c.solvers[0], walls)->layers));
  wcsph::Parameters p;
  p.particle_distance_m = l0;
  p.speed_of_sound_m_s = 30;
  p.water_height_m = level;
  p.walls = model;
  const std::unique_ptr<Solver> solver = make_wcsph_solver(scene, p, 1);
  solver->step();
  const SensorArray array(c, scene, solver->smoothing_length_m(), "wcsph", walls);
  const std::vector<std::string> names = array.columns();
  std::vector<double> values;
  array.sample(*solver, values);
  std::map<std::string, double> by_name;
  for (std::size_t i = 0; i < names.size(); ++i) by_name[names[i]] = values.at(i);
  return by_name;
}

TEST(SensorsOnWcsph, AStillTankReadsItsDepths) {
  const double l0 = 0.02;
  auto read = readings("extrapolated", wcsph::WallModel::extrapolated, l0);
  EXPECT_NEAR(read["H1_m"], level, 0.1 * l0);
  EXPECT_NEAR(read["H1_top_m"], level, 0.1 * l0);
  EXPECT_NEAR(read["H2_m"], level - 0.1, 0.1 * l0);
  EXPECT_NEAR(read["P1_wall_Pa"], weight * (level - 0.06), 0.05 * weight * level);
  EXPECT_NEAR(read["P2_wall_Pa"], weight * (level - 0.1), 0.05 * weight * level);
  EXPECT_NEAR(read["P3_wall_Pa"], weight * (level - 0.14), 0.05 * weight * level);
  EXPECT_EQ(read["P1_Pa"], read["P1_wall_Pa"]);
}

TEST(SensorsOnWcsph, TheKernelReadsThePressureWhereItStands) {
  const double l0 = 0.02;
  const double h = 1.5 * l0;
  auto read = readings("extrapolated", wcsph::WallModel::extrapolated, l0);
  EXPECT_NEAR(read["P1_kernel_Pa"], weight * (level - 0.06), 0.05 * weight * level);
  EXPECT_NEAR(read["P2_kernel_Pa"], weight * (level - 0.1 - h), 0.05 * weight * level);  // its point stands h higher
  EXPECT_NEAR(read["P3_kernel_Pa"], weight * (level - 0.14), 0.05 * weight * level);
  EXPECT_NEAR(read["P3_kernel_support_1"], 0.975, 0.02);  // the wall, h away, cuts off 2.5 % of the kernel's weight
}

TEST(SensorsOnWcsph, OneLayerOfDynamicWallsIsEnoughForWaveHeights) {
  const double l0 = 0.02;
  auto read = readings("dynamic", wcsph::WallModel::dynamic, l0);
  EXPECT_NEAR(read["H1_m"], level, 0.1 * l0);
  EXPECT_NEAR(read["H2_m"], level - 0.1, 0.1 * l0);
  EXPECT_EQ(read["P1_Pa"], read["P1_kernel_Pa"]);
}

}  // namespace
}  // namespace sluice
