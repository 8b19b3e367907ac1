// What fills space at the start: fluid, tank walls and obstacles, as boxes and then as particles on one lattice.
// Coordinates: x along the tank from the downstream wall, y across, z up; SI units throughout.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "solvers/vec3.h"

namespace sluice {

/// An axis-parallel box [m].
struct Box {
  Vec3d lower;
  Vec3d upper;
};

/// Whether a point lies in a box or on its faces.
inline bool holds_point(const Box& b, const Vec3d& p) {
  return p.x >= b.lower.x && p.x <= b.upper.x && p.y >= b.lower.y && p.y <= b.upper.y && p.z >= b.lower.z &&
         p.z <= b.upper.z;
}

inline double longest_edge(const Box& b) {
  return std::max({b.upper.x - b.lower.x, b.upper.y - b.lower.y, b.upper.z - b.lower.z});
}

/// The geometry and fluid of a case, as nominal (unfitted) lengths. A tank is its inner faces, open at the top.
struct SceneDescription {
  Box tank;
  std::vector<Box> fluid;
  std::vector<Box> obstacles;
  double particle_distance_m = 0;
  int wall_layers = 3;  ///< particle layers behind each wet face
  Vec3d gravity_m_s2{0, 0, -9.81};
  double reference_density_kg_m3 = 1000;
};

/// One length that had to be fitted to the lattice.
struct FittedLength {
  std::string name;  ///< such as "fluid[0].upper.z"
  double nominal_m = 0;
  double fitted_m = 0;
};

struct WallParticle {
  Vec3d position;
  int layer = 0;  ///< 0 touches the fluid
  int body = 0;   ///< 0 the tank, 1 + k obstacle k
};

struct ParticleCounts {
  std::int64_t fluid = 0;
  std::int64_t solid = 0;
};

/// Particles on the lattice: at cell centres, so that a wall's face lies midway between the first wall layer and the
/// first fluid layer. `description` keeps the nominal lengths, `fitted` the same geometry on the lattice.
struct Scene {
  SceneDescription description;
  SceneDescription fitted;
  std::vector<FittedLength> fitted_lengths;  ///< only those that changed by more than 1e-9 m
  std::vector<Vec3d> fluid;
  std::vector<WallParticle> walls;
  double nominal_fluid_volume_m3 = 0;
  double fluid_volume_m3 = 0;
};

/// Particle counts without building the particles: for planning and for the check against memory.
/// Throws std::invalid_argument when a box does not make sense at this particle distance (the message names it).
ParticleCounts count_particles(const SceneDescription& description);

/// Builds the lattice. Throws std::invalid_argument as above.
Scene build_scene(const SceneDescription& description);

}  // namespace sluice
