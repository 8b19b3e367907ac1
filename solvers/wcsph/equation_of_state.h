// The Tait equation (Eq. 8) in terms of the density's deviation from the reference, so that no digits are lost at small
// compressions. The exponent is 7, as in the paper.
#pragma once

#include <cmath>

namespace sluice::wcsph {

/// B = rho_0 c_0^2 / gamma   [Pa]
struct Tait {
  double reference_density_kg_m3;
  double speed_of_sound_m_s;

  double stiffness_Pa() const { return reference_density_kg_m3 * speed_of_sound_m_s * speed_of_sound_m_s / 7.0; }
};

/// P = B [(rho / rho_0)^7 - 1]   [Pa]   Eq. (8), expanded in s = (rho - rho_0) / rho_0.
template <class Real>
Real tait_pressure(Real density_deviation, const Tait& tait) {
  const Real s = density_deviation * static_cast<Real>(1.0 / tait.reference_density_kg_m3);
  const Real series = s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s))))));
  return static_cast<Real>(tait.stiffness_Pa()) * series;
}

/// rho - rho_0 [kg/m^3] that gives a pressure [Pa]: Eq. (8) inverted. Pressures at or below -B have no density.
template <class Real>
Real tait_density_deviation(Real pressure_Pa, const Tait& tait) {
  const double ratio = static_cast<double>(pressure_Pa) / tait.stiffness_Pa();
  return static_cast<Real>(tait.reference_density_kg_m3 * std::expm1(std::log1p(ratio) / 7.0));
}

/// c = sqrt(dP/drho) = c_0 (rho / rho_0)^3   [m/s]
template <class Real>
Real tait_speed_of_sound(Real density_deviation, const Tait& tait) {
  const Real ratio = 1 + density_deviation * static_cast<Real>(1.0 / tait.reference_density_kg_m3);
  return static_cast<Real>(tait.speed_of_sound_m_s) * ratio * ratio * ratio;
}

}  // namespace sluice::wcsph
