// The variable time step (Eq. 15).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solvers/wcsph/pair_sums.h"

namespace sluice::wcsph {

/// Cr sqrt(h / |f|)   [s]   first condition of Eq. (15); no limit where nothing accelerates
inline double force_time_step(double courant, double h_m, double acceleration_m_s2) {
  return acceleration_m_s2 > 0 ? courant * std::sqrt(h_m / acceleration_m_s2) : std::numeric_limits<double>::infinity();
}

/// Cr h / (c_0 + max |mu|)   [s]   second condition of Eq. (15), with the absolute value of the viscous term
inline double sound_time_step(double courant, double h_m, double speed_of_sound_m_s, double mu_m_s) {
  return courant * h_m / (speed_of_sound_m_s + mu_m_s);
}

/// Both conditions hold for all particles: the first at the largest acceleration, the second at the largest |mu|.
inline double time_step(const Parameters& p, const StepLimits& limits) {
  const double h = p.smoothing_length_m();
  return std::min(force_time_step(p.courant, h, limits.acceleration_m_s2),
                  sound_time_step(p.courant, h, p.speed_of_sound_m_s, limits.mu_m_s));
}

/// Shortest step against Cr h / c_0. The hardest impacts of sound runs ask for a twentieth (l0 = 0.015 m).
inline constexpr double collapsed_share = 1e-3;

/// Throws std::runtime_error for a step so short, or not a number, that the run would crawl for ever: it has become
/// unstable.
inline void require_progress(const Parameters& p, double dt_s, double time_s) {
  const double usual_s = sound_time_step(p.courant, p.smoothing_length_m(), p.speed_of_sound_m_s, 0);
  if (dt_s >= collapsed_share * usual_s) return;
  throw std::runtime_error(fmt::format(
      "the run has become unstable at t = {:.4g} s: a time step of {:.2e} s is asked for, {:.2e} s is usual; try "
      "a smaller courant or restart_interval, or a larger alpha",
      time_s, dt_s, usual_s));
}

}  // namespace sluice::wcsph
