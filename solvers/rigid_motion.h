// Prescribed motions of rigid bodies.
#pragma once

#include <algorithm>

#include "solvers/vec3.h"

namespace sluice {

/// At rest, then at a constant velocity from start_s to stop_s, then at rest again.
struct RigidMotion {
  Vec3d velocity_m_s;
  double start_s = 0;
  double stop_s = 0;

  bool moves() const { return dot(velocity_m_s, velocity_m_s) > 0 && stop_s > start_s; }
  Vec3d displacement_m(double t_s) const { return (std::clamp(t_s, start_s, stop_s) - start_s) * velocity_m_s; }
  Vec3d velocity_at(double t_s) const { return t_s >= start_s && t_s < stop_s ? velocity_m_s : Vec3d{}; }
};

}  // namespace sluice
