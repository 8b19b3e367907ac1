// The Verlet scheme (Eq. 9 to 14).
#pragma once

#include "solvers/wcsph/particles.h"

namespace sluice::wcsph {

/// Which form of the scheme a step takes: the leap over 2 dt from t - dt (Eq. 9 and 11), or the restart from t (Eq. 12
/// and 14) once every N_s steps, which keeps the odd and even steps from drifting apart.
enum class VerletForm { leap, restart };

/// q(t + dt) from q(t - dt) or q(t) and the rate at t.   Eq. (9), (11), (12), (14)
template <class Real>
Real verlet_value(Real at_t, Real before, Real rate, Real dt_s, VerletForm form) {
  return form == VerletForm::leap ? before + 2 * dt_s * rate : at_t + dt_s * rate;
}

/// r(t + dt) - r(t) = dt u + dt^2/2 a   [m]   Eq. (10) and (13)
inline double verlet_displacement(double velocity, double acceleration, double dt_s) {
  return dt_s * velocity + 0.5 * dt_s * dt_s * acceleration;
}

/// Moves fluid particles by one step; their densities rho - rho_0 [kg/m^3] do not fall below the least. Returns the
/// longest displacement [m].
template <class Pack>
double advance_fluid(Particles<Pack>& fluid, double dt_s, VerletForm form, double least_density, int threads);

/// Integrates the density of dynamic walls, never below the reference density.
template <class Pack>
void advance_wall_density(Particles<Pack>& walls, double dt_s, VerletForm form, int threads);

}  // namespace sluice::wcsph
