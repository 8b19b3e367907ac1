// The terms of the discrete equations, one function a term. i is the particle, j its neighbour; as in the paper
// r_ij = r_j - r_i and u_ij = u_j - u_i, so the approach u_ij . r_ij is negative for a pair that closes in.
// g is the shape of the kernel's gradient (kernel.h): grad_i W_ij = G0 g r_ij. What is the same for all pairs of a sum
// (G0, the particle mass m, and other constants named below) is left to the sum's end, since a pair is visited a
// thousand million times. Real is double, or a pack of single precision.
#pragma once

#include "solvers/lanes.h"
#include "solvers/vec3.h"

namespace sluice::wcsph {

/// First term of the continuity equation, m_j (u_i - u_j) . grad_i W_ij, over m G0   [m^2/s]   Eq. (7)
/// The sign is that of mass conservation (the paper prints the opposite one): a pair that approaches gains density.
template <class Real>
[[gnu::always_inline]] inline Real continuity_term(const Real& g, const Real& approach) {
  return -(g * approach);
}

/// Density diffusion, 2 delta h c_0 (rho_j - rho_i) (r_ij . grad_i W_ij) / |r_ij|^2 m_j / rho_j, over 2 delta h c_0 G0
/// [kg] Eq. (7), second term. With grad_i W_ij along r_ij the distance cancels.
template <class Real>
[[gnu::always_inline]] inline Real diffusion_term(const Real& density_i, const Real& density_j, const Real& volume_j,
                                                  const Real& g) {
  return (density_j - density_i) * (g * volume_j);
}

/// mu_ij / h = u_ij . r_ij / (|r_ij|^2 + eta^2)   [1/s]   Eq. (5)
/// Pi_ij = -alpha c_ij mu_ij / rho_ij where the pair approaches, else 0, over alpha h   [m^4/(kg s^2)]   Eq. (4)
template <class Real>
struct ArtificialViscosity {
  Real mu;
  Real Pi;
};

/// Both quotients share one division, by (|r_ij|^2 + eta^2) (rho_i + rho_j): the dearest operation of the pair loop.
template <class Real>
[[gnu::always_inline]] inline ArtificialViscosity<Real> artificial_viscosity(const Real& approach,
                                                                             const Real& distance2, const Real& eta2,
                                                                             const Real& sum_of_densities,
                                                                             const Real& sum_of_sound_speeds) {
  const Real quotient = approach / ((distance2 + eta2) * sum_of_densities);
  // c_ij / rho_ij = (c_i + c_j) / (rho_i + rho_j)
  return {quotient * sum_of_densities, -(sum_of_sound_speeds * smaller(quotient, Real{}))};
}

/// The neighbour's pressure, or the one with which P_i + P_j is the least sum that the pair bears   [Pa]
template <class Real>
[[gnu::always_inline]] inline Real borne_pressure(const Real& pressure_i, const Real& pressure_j,
                                                  const Real& least_sum) {
  return larger(pressure_j, least_sum - pressure_i);
}

/// m_j [(P_i + P_j) / (rho_i rho_j) + Pi_ij] g, of which the acceleration is minus G0 times the sum times r_ij
/// [m^5/s^2]   Eq. (3); volume_j = m_j / rho_j and `viscous` = m_j Pi_ij.
template <class Real>
[[gnu::always_inline]] inline Real momentum_term(const Real& pressure_i, const Real& pressure_j,
                                                 const Real& inverse_density_i, const Real& volume_j,
                                                 const Real& viscous, const Real& g) {
  return ((pressure_i + pressure_j) * (inverse_density_i * volume_j) + viscous) * g;
}

/// Pressure that a fluid particle f hands to a wall particle w: p_f + rho_f (g - a_w) . (r_w - r_f)   [Pa]
/// (Adami, Hu and Adams 2012, J. Comput. Phys. 231:7057, Eq. 27); the wall takes the kernel mean of it.
template <class Real>
[[gnu::always_inline]] inline Real extrapolated_pressure(const Real& pressure_f, const Real& density_f,
                                                         const Vec3<Real>& gravity_less_wall_acceleration,
                                                         const Vec3<Real>& wall_from_fluid) {
  return pressure_f + density_f * dot(gravity_less_wall_acceleration, wall_from_fluid);
}

}  // namespace sluice::wcsph
