// Small scenes for the solver's tests: a tank with a block of fluid in it, and the parameters to go with it.
#pragma once

#include <cmath>

#include "solvers/scene.h"
#include "solvers/wcsph/parameters.h"

namespace sluice::wcsph {

/// A tank of the given inner lengths [m], filled to a depth over its whole floor.
inline SceneDescription still_tank(double l0, double length, double width, double height, double depth,
                                   WallModel walls) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, {length, width, height}};
  d.fluid = {{{0, 0, 0}, {length, width, depth}}};
  d.particle_distance_m = l0;
  d.wall_layers = walls == WallModel::dynamic ? 1 : 3;
  return d;
}

/// A dam break in a small tank with a box: every part of the solver at work. A `length` of 2 m has room for several
/// blocks of the pair sums along x.
inline Scene small_dam_break(WallModel walls, double length = 0.8) {
  SceneDescription d = still_tank(0.04, length, 0.24, 0.4, 0.24, walls);
  d.fluid[0].lower.x = length - 0.3;
  if (length > 1) d.fluid[0].lower.x = 0.4;
  // Wide enough to have an inside, so that fluid in it is told as lost.
  d.obstacles = {{.box = {{0.16, 0.04, 0}, {0.32, 0.2, 0.12}}}};
  return build_scene(d);
}

inline Parameters parameters_for(const SceneDescription& d, double depth, WallModel walls) {
  Parameters p;
  p.particle_distance_m = d.particle_distance_m;
  p.water_height_m = depth;
  p.gravity_m_s2 = d.gravity_m_s2;
  p.speed_of_sound_m_s = 20 * std::sqrt(9.81 * depth);
  p.walls = walls;
  return p;
}

inline Parameters small_parameters(const Scene& scene, WallModel walls) {
  return parameters_for(scene.description, 0.24, walls);
}

/// A scene with fluid particles at given places only, in a tank too large for its walls to be felt, without gravity.
inline Scene free_particles(double l0, std::vector<Vec3d> positions) {
  SceneDescription d = still_tank(l0, 40 * l0, 40 * l0, 40 * l0, 4 * l0, WallModel::dynamic);
  d.gravity_m_s2 = {0, 0, 0};
  Scene scene = build_scene(d);
  scene.fluid = std::move(positions);
  return scene;
}

inline Parameters free_parameters(double l0) {
  Parameters p;
  p.particle_distance_m = l0;
  p.speed_of_sound_m_s = 40;
  p.gravity_m_s2 = {0, 0, 0};
  p.walls = WallModel::dynamic;
  p.water_height_m = -1;
  return p;
}

}  // namespace sluice::wcsph
