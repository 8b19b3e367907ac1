// What the paper leaves out: short-range models that keep fluid particles from clustering and from passing through
// walls. Both change predicted velocities, before anything moves. A single collision or contact takes energy away; of
// several at once, all reckoned from the same velocities, a crowd straight ahead could give some back. In runs the
// energy falls (see solvers/README.md).
//
// Fluid: pairs that approach and would be closer than Parameters::collision_over_distance collide with restitution e
// (Lee, Park, Kim and Hwang 2011, Comput. Methods Appl. Mech. Eng. 200:1113).
//
// Walls: the same model between fluid and wall particles makes the wall as rough as its lattice, and a front that runs
// over it is held back (see solvers/README.md). So a wall is met along its normal: a particle that is
// nearer to the wall's layer than Parameters::wall_contact_over_distance, or would be within the step, loses what
// velocity it has into the wall, and keeps the rest.
#pragma once

#include <cstdint>
#include <span>

#include "solvers/box.h"
#include "solvers/mps/neighbours.h"
#include "solvers/mps/operators.h"
#include "solvers/mps/particles.h"

namespace sluice::mps {

/// Velocities after collisions and contacts, all from the same predicted ones, into `after`. `wall_normals` points from
/// each wall particle into the fluid, first_wall() first. Returns the number of particles whose velocity changed.
template <class Pack>
std::int64_t collide(const Particles<Pack>& particles, const VectorField<double>& wall_normals,
                     const NeighbourList<Pack>& list, const OperatorConstants& c,
                     VectorField<typename Lanes<Pack>::Real>& after, int threads);

/// Within this distance two particles, or a particle and a wall, may meet in the next step   [m]
double collision_reach_m(const Parameters& parameters);

/// The solids as they lie now.
struct SolidSets {
  const RowIndex& dummies;  ///< particle k is particle k of the run
  const RowIndex& walls;    ///< particle k is particle first_wall() + k
  /// Which body with a motion of its own each wall particle belongs to, first_wall() first; 0: none, as all that stand
  /// still together. Empty where nothing moves.
  std::span<const std::int8_t> moving_body;
};

/// Finds the unit normals of the wall particles into the fluid: away from the dummy particles behind them, and from
/// walls of bodies that move against their own, so that a shut gate and its frame have one plane normal. `normals` has
/// those of before; those that particles within the box `moved` can have changed are found anew.
template <class Pack>
void find_wall_normals(const Particles<Pack>& particles, const SolidSets& solids, double particle_distance_m,
                       const Box& moved, int threads, VectorField<double>& normals);

}  // namespace sluice::mps
