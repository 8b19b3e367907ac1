// What the fluid as a whole has, for every solver alike.
#pragma once

#include <cstddef>

#include "solvers/fields.h"
#include "solvers/solver.h"

namespace sluice {

/// Sums over fluid particles first .. first + n - 1, all of one mass, in their order and in double precision. The
/// compression is left to the solver, which knows what it means by density.
template <class Real>
FluidTotals energies(const VectorField<double>& position_m, const VectorField<Real>& velocity_m_s, std::size_t first,
                     std::size_t n, double mass_kg, const Vec3d& gravity_m_s2) {
  FluidTotals totals;
  for (std::size_t i = first; i < first + n; ++i) {
    const Vec3d u = velocity_m_s.template at<double>(i);
    totals.kinetic_energy_J += dot(u, u);
    totals.potential_energy_J += dot(gravity_m_s2, position_m.at<double>(i));
  }
  totals.kinetic_energy_J *= 0.5 * mass_kg;
  totals.potential_energy_J *= -mass_kg;
  return totals;
}

}  // namespace sluice
