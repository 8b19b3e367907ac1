// The Wendland kernel (Eq. 6) and its gradient, in three dimensions.
#pragma once

#include <numbers>

#include "solvers/lanes.h"

namespace sluice::wcsph {

/// W(q) = varpi (1 - q/2)^4 (2q + 1) for 0 <= q <= 2 with q = r/h and varpi = 21 / (16 pi h^3)   [1/m^3]   Eq. (6)
/// (the paper's typesetting hides the fraction; with it the kernel's integral is one).
struct Wendland {
  double smoothing_length_m;

  double normalisation() const {
    const double h = smoothing_length_m;
    return 21.0 / (16.0 * std::numbers::pi * h * h * h);
  }
};

/// (1 - q/2), zero beyond the kernel's radius: the one factor on which all else rests. `half_per_h` is 1/(2h) in the
/// reciprocal of the distance's unit.
template <class Real>
[[gnu::always_inline]] inline Real wendland_taper(const Real& distance, const Real& half_per_h) {
  return larger(1 - distance * half_per_h, Real{});
}

/// W [1/m^3] from the taper.   Eq. (6); 2q + 1 = 5 - 4 (1 - q/2)
template <class Real>
[[gnu::always_inline]] inline Real wendland_weight(const Real& taper, const Real& normalisation) {
  const Real t2 = taper * taper;
  return normalisation * (t2 * t2) * (5 - 4 * taper);
}

/// With r_ij = r_j - r_i the gradient is grad_i W_ij = G0 g r_ij, from dW/dq = -5 varpi q (1 - q/2)^3: the constant G0
/// = 5 varpi / h^2 [1/m^5], which sums take as a factor once at their end, and g = (1 - q/2)^3 [1]. No division by the
/// distance is left, so a pair at zero distance needs no special case.
template <class Real>
[[gnu::always_inline]] inline Real wendland_gradient_shape(const Real& taper) {
  return taper * taper * taper;
}

/// G0 = 5 varpi / h^2   [1/m^5]
inline double wendland_gradient_constant(const Wendland& kernel) {
  return 5.0 * kernel.normalisation() / (kernel.smoothing_length_m * kernel.smoothing_length_m);
}

}  // namespace sluice::wcsph
