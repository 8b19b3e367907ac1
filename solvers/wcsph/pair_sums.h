// The loops over pairs. Fluid pairs are visited once and written to both sides, block by block in colours, so that
// every particle receives its terms in one order; the others are gathered for one particle in a fixed order and written
// once. So results do not depend on the number of threads. (The design would gather them all; a pair that is visited
// once costs less.)
#pragma once

#include "solvers/cell_rows.h"
#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/parameters.h"
#include "solvers/wcsph/particles.h"

namespace sluice::wcsph {

/// In what pairs with walls differ from pairs of fluid.
template <class Pack>
struct PairLaw {
  Pack least_pressure_sum;  ///< P_i + P_j [Pa] counts as this where it is less
  Pack viscosity_factor;    ///< m alpha h   [kg quantum]
};

/// What every pair needs to know, in the precision of the path. Pair distances are in quanta of the fixed-point
/// coordinates (the reference path: metres); factors that a whole sum has in common are applied at its end.
template <class Pack>
struct PairConstants {
  using Real = typename Lanes<Pack>::Real;

  PairConstants(const Parameters& p, double quantum_m);

  Pack half_per_h;         ///< 1 / (2h)   [1/quantum]
  Pack eta2;               ///< 0.01 h^2   [quantum^2]
  Pack weight_factor;      ///< varpi   [1/m^3]
  Real mass;               ///< m = rho_0 l0^3   [kg]
  Real momentum_factor;    ///< G0   [1/m^5], times metres a quantum
  Real continuity_factor;  ///< m G0   [kg/m^5], times metres a quantum
  Real diffusion_factor;   ///< 2 delta h c_0 G0   [1/(m^3 s)]
  PairLaw<Pack> with_fluid;
  /// Extrapolated walls push but do not pull: else a stretched particle of spray is drawn through the floor. Dynamic
  /// walls are left as the paper has them.
  PairLaw<Pack> with_wall;
  double mu_factor;  ///< h   [quantum]: |mu| in m/s from the sums' mu / h
  Real reference_density;
  Real least_pressure;   ///< P that the fluid bears   [Pa]
  double least_density;  ///< rho - rho_0 of a particle that is alone, rho = m W(0), below which none falls   [kg/m^3]
  Vec3<Real> gravity;    ///< [m/s^2]
  Vec3<Real> gravity_per_quantum;  ///< g times metres a quantum: r_ij . g from distances in quanta
  Tait tait;
};

/// Sorted particles with the index that finds neighbours among them, and how far they may have moved since it was made.
template <class Pack>
struct Sorted {
  const Particles<Pack>& particles;
  const RowIndex& index;
  double travel_m = 0;
};

/// Wall particles move, between two sorts, by no more than the search's slack: where they may be near is known
/// beforehand.
template <class Pack>
struct SortedWalls {
  Sorted<Pack> sorted;
  const Proximity& proximity;
};

/// The largest values over all particles that limit the time step.
struct StepLimits {
  double acceleration_m_s2 = 0;  ///< max |f_i|
  double mu_m_s = 0;             ///< max |mu_ij|
};

/// Acceleration and density rate of every fluid particle from fluid and wall neighbours: Eq. (3) and (7).
template <class Pack>
StepLimits sum_fluid_rates(Particles<Pack>& fluid, const Sorted<Pack>& fluid_neighbours, const SortedWalls<Pack>& walls,
                           const PairConstants<Pack>& constants, int threads);

/// Density rate of the wall particles in `wet` from its fluid neighbours: the first term of Eq. (7), for dynamic walls.
template <class Pack>
void sum_wall_density_rates(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                            const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads);

/// Density of the wall particles in `wet` from their pressure: the kernel mean of what its fluid neighbours hand to it,
/// not below zero, turned round by the equation of state. A wall particle without fluid around it has no pressure.
template <class Pack>
void extrapolate_wall_pressures(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                                const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads);

}  // namespace sluice::wcsph
