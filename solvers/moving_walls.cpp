#include "solvers/moving_walls.h"

#include <algorithm>
#include <cmath>

namespace sluice {

MovingWalls::MovingWalls(const Scene& scene) {
  for (const Obstacle& o : scene.fitted.obstacles) motions_.push_back(o.motion);
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const WallParticle& w = scene.walls[k];
    if (w.body == 0) continue;
    const auto motion = static_cast<std::uint32_t>(w.body - 1);
    if (motions_[motion].moves()) particles_.push_back({w.position, static_cast<std::int32_t>(k), motion});
  }
}

double MovingWalls::travel_m(double from_s, double to_s) const {
  double longest2 = 0;
  for (const RigidMotion& m : motions_) {
    const Vec3d d = m.displacement_m(to_s) - m.displacement_m(from_s);
    longest2 = std::max(longest2, dot(d, d));
  }
  return std::sqrt(longest2);
}

bool MovingWalls::change(double from_s, double to_s) const {
  return std::any_of(motions_.begin(), motions_.end(), [&](const RigidMotion& m) {
    return m.displacement_m(from_s) != m.displacement_m(to_s) || m.velocity_at(from_s) != m.velocity_at(to_s);
  });
}

}  // namespace sluice
