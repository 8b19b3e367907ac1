// The Tait equation (Eq. 8) in terms of the density's deviation from the reference, so that no digits are lost at small
// compressions. The exponent is 7, as in the paper.
#pragma once

#include "solvers/lanes.h"

namespace sluice::wcsph {

/// B = rho_0 c_0^2 / gamma   [Pa]
struct Tait {
  double reference_density_kg_m3;
  double speed_of_sound_m_s;

  double stiffness_Pa() const { return reference_density_kg_m3 * speed_of_sound_m_s * speed_of_sound_m_s / 7.0; }
};

/// P / B = (1 + s)^7 - 1 with s = (rho - rho_0) / rho_0, expanded.
template <class Real>
Real tait_series(const Real& s) {
  return s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s))))));
}

/// P = B [(rho / rho_0)^7 - 1]   [Pa]   Eq. (8)
template <class Real>
Real tait_pressure(Real density_deviation, const Tait& tait) {
  const Real s = density_deviation * static_cast<Real>(1.0 / tait.reference_density_kg_m3);
  return static_cast<Real>(tait.stiffness_Pa()) * tait_series(s);
}

/// rho - rho_0 [kg/m^3] that gives a pressure [Pa] of -B/2 to 16 B: Eq. (8) inverted. Newton's method from an expansion
/// of (1 + P/B)^(1/7) that is right to second order; the steps are as many as 16 B needs in double precision. Real is
/// double or a pack.
template <class Real>
Real tait_density_deviation(const Real& pressure_Pa, const Tait& tait) {
  using Scalar = typename Lanes<Real>::Real;
  const Real ratio = pressure_Pa * static_cast<Scalar>(1.0 / tait.stiffness_Pa());
  Real s = ratio / (7 + 3 * ratio);
  for (int step = 0; step < 6; ++step) {
    const Real slope3 = (1 + s) * (1 + s) * (1 + s);
    s -= (tait_series(s) - ratio) / (7 * (slope3 * slope3));
  }
  return s * static_cast<Scalar>(tait.reference_density_kg_m3);
}

/// c = sqrt(dP/drho) = c_0 (rho / rho_0)^3   [m/s]
template <class Real>
Real tait_speed_of_sound(Real density_deviation, const Tait& tait) {
  const Real ratio = 1 + density_deviation * static_cast<Real>(1.0 / tait.reference_density_kg_m3);
  return static_cast<Real>(tait.speed_of_sound_m_s) * ratio * ratio * ratio;
}

}  // namespace sluice::wcsph
