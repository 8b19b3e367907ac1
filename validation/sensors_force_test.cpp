// Forces by both routes against the exact force of water at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "solvers/mps/mps_solver.h"
#include "solvers/wcsph/wcsph_solver.h"
#include "validation/case.h"
#include "validation/sensors.h"

namespace sluice {
namespace {

constexpr double l0 = 0.01;
constexpr double depth_m = 10 * l0;

/// Water ten particles deep around a column that stands through its surface.
Case still_water() {
  Case c;
  c.tank = {{0, 0, 0}, {0.36, 0.24, 0.2}};
  c.fluid = {{{0, 0, 0}, {0.36, 0.24, depth_m}}};
  c.obstacles = {{.box = {{0.14, 0.08, 0}, {0.22, 0.16, 0.2}}, .name = "column"}};
  c.gravity_m_s2 = {0, 0, -9.81};
  c.density_kg_m3 = 1000;
  c.water_height_m = depth_m;
  return c;
}

const std::string dynamic_walls = "wcsph, dynamic walls";

std::unique_ptr<Solver> make(const std::string& solver, const Case& c, const Scene& scene) {
  if (solver == "mps") {
    mps::Parameters p;
    p.particle_distance_m = l0;
    p.greatest_speed_m_s = 2;
    return make_mps_solver(scene, p, 1);
  }
  wcsph::Parameters p;
  p.particle_distance_m = l0;
  p.water_height_m = c.water_height_m;
  p.speed_of_sound_m_s = 20 * std::sqrt(9.81 * depth_m);
  p.wall_friction = 0;
  if (solver == dynamic_walls) p.walls = wcsph::WallModel::dynamic;
  return make_wcsph_solver(scene, p, 1);
}

constexpr double column_width_m = 0.08;

/// What a force sensor looks at. Without a face: the whole body, of which the force along x is read.
struct Wall {
  std::string name;
  std::string body;
  std::string face;
};

const std::vector<Wall>& walls() {
  static const std::vector<Wall> all{{"end wall", "tank", "x+"},
                                     {"side x+", "column", "x+"},
                                     {"side x-", "column", "x-"},
                                     {"side y-", "column", "y-"},
                                     {"whole column", "column", ""}};
  return all;
}

/// Of a face the force into the body.
CaseSensor force_on(const Wall& wall) {
  CaseSensor s;
  s.name = std::string("F");
  s.kind = SensorKind::force;
  s.body = wall.body;
  s.normal = {1, 0, 0};
  if (wall.face.empty()) return s;
  const bool along_x = wall.face[0] == 'x';
  const bool upwards = wall.face[1] == '+';
  s.face = {along_x ? 0 : 1, upwards};
  s.normal = along_x ? Vec3d{upwards ? -1.0 : 1.0, 0, 0} : Vec3d{0, upwards ? -1.0 : 1.0, 0};
  return s;
}

/// One force by both routes   [N]
struct Force {
  double acceleration_N = 0;
  double pressure_N = 0;
};

/// Means over the last fifth of a second, by the walls' names.
struct AtRest {
  std::map<std::string, Force> forces;
  double level_m = 0;

  /// The exact force on a side: of water as deep as it stands then.
  double exact_N(double width_m) const { return 0.5 * 1000 * 9.81 * level_m * level_m * width_m; }
};

AtRest run_to_rest(const std::string& solver_name) {
  const Case c = still_water();
  const Scene scene = build_scene(scene_description(c, l0, solver_name == dynamic_walls ? 1 : 3));
  const auto solver = make(solver_name, c, scene);
  std::vector<std::unique_ptr<Sensor>> sensors;
  for (const Wall& wall : walls()) sensors.push_back(make_force_sensor(force_on(wall), "acceleration", scene));
  const ProbeLine line{0.3, 0.2, 0, 0.2, l0, solver->smoothing_length_m()};
  std::vector<double> sums(3 * walls().size(), 0.0);
  AtRest mean;
  int samples = 0;
  while (solver->time_s() < 1) {
    solver->step();
    if (solver->time_s() < 0.8 || solver->steps() % 5 != 0) continue;
    std::vector<double> values;
    for (const auto& sensor : sensors) sensor->append_values(*solver, values);
    for (std::size_t k = 0; k < values.size(); ++k) sums[k] += values[k];
    mean.level_m += wave_heights(*solver, line).column_m;
    ++samples;
  }
  mean.level_m /= samples;
  for (std::size_t k = 0; k < walls().size(); ++k)
    mean.forces[walls()[k].name] = {sums[3 * k + 1] / samples, sums[3 * k + 2] / samples};
  return mean;
}

/// One run for all tests.
const AtRest& at_rest(const std::string& solver_name) {
  static std::map<std::string, AtRest> runs;
  const auto found = runs.find(solver_name);
  return found != runs.end() ? found->second : runs.emplace(solver_name, run_to_rest(solver_name)).first->second;
}

class StillWater : public ::testing::TestWithParam<std::string> {};

/// MPS settles by kappa_r's softness, by 1.4 % here. Its particles at the surface have P = 0 at their centres, so that
/// its water stands half a particle lower than the tank's, at the surface as on the floor.
TEST_P(StillWater, BothRoutesGiveTheExactForce) {
  const AtRest& water = at_rest(GetParam());
  EXPECT_NEAR(water.level_m / depth_m, 1, 0.025);
  for (const char* name : {"end wall", "side x+", "side y-"}) {
    const double exact_N = water.exact_N(name == std::string("end wall") ? 0.24 : column_width_m);
    const Force& force = water.forces.at(name);
    EXPECT_NEAR(force.acceleration_N / exact_N, 1, 0.03) << "acceleration, " << name;
    EXPECT_NEAR(force.pressure_N / exact_N, 1, 0.03) << "pressure, " << name;
  }
}

/// A body without a face is read net of its far side: with water at rest all around it nothing is left, to a few per
/// cent of what presses on one side. By pressures that is the difference of the two sides' readings; by accelerations
/// it is a sum of its own, since only faces are cut out of their fluid.
TEST_P(StillWater, NetForceOnAWholeBodyIsNone) {
  const AtRest& water = at_rest(GetParam());
  const double side_N = water.exact_N(column_width_m);
  const Force& net = water.forces.at("whole column");
  EXPECT_NEAR(net.acceleration_N / side_N, 0, 0.03);
  EXPECT_NEAR(net.pressure_N / side_N, 0, 0.03);
  const double difference_N = water.forces.at("side x-").pressure_N - water.forces.at("side x+").pressure_N;
  EXPECT_NEAR(net.pressure_N / side_N, difference_N / side_N, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Solvers, StillWater, ::testing::Values("wcsph", "mps"));

/// The paper's walls miss the 3 % by either route: accelerations give 7 to 13 % too little, since fluid stands h off
/// the wall, and pressures 1.6 to 1.9 times the exact force, since a wall's density ratchets upwards.
TEST(StillWaterBeforeDynamicWalls, AccelerationsGiveTheForceToAnEighthAndPressuresDoNot) {
  const AtRest& water = at_rest(dynamic_walls);
  for (const char* name : {"end wall", "side x+", "side y-"}) {
    const double exact_N = water.exact_N(name == std::string("end wall") ? 0.24 : column_width_m);
    const Force& force = water.forces.at(name);
    EXPECT_NEAR(force.acceleration_N / exact_N, 0.92, 0.08) << "acceleration, " << name;
    EXPECT_GT(force.pressure_N / exact_N, 1.4) << "if this has become right, hold it to the others' bounds: " << name;
  }
}

/// A reading of zero must not come of a sum over nothing.
TEST(WallPatch, OfAWholeBodyHoldsEveryParticleOfItAndOfTheFloorUnderIt) {
  const Scene scene = build_scene(scene_description(still_water(), l0, 3));
  const WallPatch patch = wall_patch(scene, "column", {});
  const auto is_column = [](const WallParticle& w) { return w.body == 1; };
  const auto of_column = std::count_if(scene.walls.begin(), scene.walls.end(), is_column);
  const std::int64_t under_it = 8 * 8 * 3;
  EXPECT_EQ(static_cast<std::int64_t>(patch.behind.size()), of_column + under_it);
  for (const WallParticle& w : scene.walls) EXPECT_TRUE(holds_point(patch.fluid_within_m, w.position));
  const auto facing = [](const std::vector<Vec3d>& normals, double x) {
    return std::ranges::count(normals, x, &Vec3d::x);
  };
  for (const double x : {-1.0, 1.0}) {
    EXPECT_EQ(facing(patch.first_normal, x), 8 * 20) << "the column's side, 0.2 m high";
    EXPECT_EQ(facing(patch.foot_normal, x), 8);
  }
}

}  // namespace
}  // namespace sluice
