// Small scenes for the MPS solver's tests.
#pragma once

#include <utility>
#include <vector>

#include "solvers/mps/parameters.h"
#include "solvers/scene.h"

namespace sluice::mps {

/// A tank of the given inner lengths [m] with a block of fluid from its lower corner on.
inline Scene tank_with_block(double l0, const Vec3d& tank, const Vec3d& block) {
  SceneDescription d;
  d.tank = {{0, 0, 0}, tank};
  d.fluid = {{{0, 0, 0}, block}};
  d.particle_distance_m = l0;
  d.wall_layers = 3;
  return build_scene(d);
}

inline Parameters parameters_for(double l0, double greatest_speed_m_s) {
  Parameters p;
  p.particle_distance_m = l0;
  p.greatest_speed_m_s = greatest_speed_m_s;
  return p;
}

/// Fluid particles at given places only, in a tank of side 40 l0 whose walls they do not feel.
inline Scene free_particles(double l0, std::vector<Vec3d> positions) {
  Scene scene = tank_with_block(l0, {40 * l0, 40 * l0, 40 * l0}, {4 * l0, 4 * l0, 4 * l0});
  scene.fluid = std::move(positions);
  return scene;
}

/// A cube of n^3 lattice positions around the middle of that tank, each displaced by up to `jitter` l0 along every
/// axis; the displacements are the same in every run.
inline std::vector<Vec3d> jittered_cube(double l0, int n, double jitter) {
  std::uint32_t state = 12345;
  const auto displacement = [&] {
    state = state * 1664525U + 1013904223U;
    return jitter * l0 * (2.0 * (state >> 8) / 16777216.0 - 1);
  };
  std::vector<Vec3d> positions;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) {
        const auto at = [&](int k) { return (20 + k - 0.5 * (n - 1)) * l0 + displacement(); };
        const double px = at(x);
        const double py = at(y);
        positions.push_back({px, py, at(z)});
      }
  return positions;
}

}  // namespace sluice::mps
