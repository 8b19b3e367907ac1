// What a probe sums over the fluid around a point, for every solver alike.
#pragma once

#include "solvers/vec3.h"
#include "solvers/wcsph/kernel.h"

namespace sluice {

/// Sums of W_ab q_b and of W_ab over particles b, with the Wendland kernel of smoothing length h: the numerator and
/// denominator of Eq. (33). q is a double or a Vec3d.
template <class Quantity>
class KernelSums {
 public:
  explicit KernelSums(double smoothing_length_m)
      : half_per_h_(0.5 / smoothing_length_m), normalisation_(wcsph::Wendland{smoothing_length_m}.normalisation()) {}

  /// Returns the particle's weight   [1/m^3]
  double add(double distance_m, const Quantity& q) {
    const double W = wcsph::wendland_weight(wcsph::wendland_taper(distance_m, half_per_h_), normalisation_);
    weights += W;
    values += W * q;
    return W;
  }

  Quantity values{};
  double weights = 0;

 private:
  double half_per_h_;
  double normalisation_;
};

/// Velocities of the sums; zero where there is no fluid.
inline Vec3d mean_velocity_m_s(const KernelSums<Vec3d>& sums) {
  return sums.weights > 0 ? (1 / sums.weights) * sums.values : Vec3d{};
}

inline double mean_pressure_Pa(const KernelSums<double>& sums) {
  return sums.weights > 0 ? sums.values / sums.weights : 0.0;
}

}  // namespace sluice
