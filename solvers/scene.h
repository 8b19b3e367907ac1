// What fills space at the start: fluid, tank walls and obstacles, as boxes and then as particles on one lattice.
// Coordinates: x along the tank from the downstream wall, y across, z up; SI units throughout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solvers/box.h"
#include "solvers/rigid_motion.h"
#include "solvers/vec3.h"

namespace sluice {

/// A solid box in the tank. One that moves is a rigid body with a prescribed motion, such as a gate.
struct Obstacle {
  Box box;             ///< where it stands at t = 0
  std::string name{};  ///< such as "block"; may be empty
  /// A plate may be thinner than three particles; on the lattice it is then made three particles thick, so that fluid
  /// on its two sides stays out of each other's reach.
  bool thin = false;
  RigidMotion motion{};
};

/// As it is called where lengths are told: its name or, without one, "obstacle[k]".
std::string called(const Obstacle& obstacle, std::size_t k);

/// The geometry and fluid of a case, as nominal (unfitted) lengths. A tank is its inner faces, open at the top.
struct SceneDescription {
  Box tank;
  std::vector<Box> fluid;
  std::vector<Obstacle> obstacles;
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

  /// Height of the fluid's surface at the start, over a point: the highest among the bodies of fluid that lie within
  /// `reach_m` of it in x and y; the tank's floor where there are none.
  double still_level_m(const Vec3d& point_m, double reach_m) const;
};

/// No fluid rises higher: what does has left over the top. Half the tank's height above its rim.
double fluid_ceiling_m(const Box& tank);

/// Particle counts without building the particles: for planning and for the check against memory.
/// Throws std::invalid_argument when a box does not make sense at this particle distance (the message names it).
ParticleCounts count_particles(const SceneDescription& description);

/// Builds the lattice. Throws std::invalid_argument as above.
Scene build_scene(const SceneDescription& description);

}  // namespace sluice
