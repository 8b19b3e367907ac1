// The wall particles of bodies that move as prescribed: where they are at a time, for every solver alike.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/scene.h"

namespace sluice {

class MovingWalls {
 public:
  explicit MovingWalls(const Scene& scene);

  bool any() const { return !particles_.empty(); }
  /// How far the body that moves most goes between two times   [m]
  double travel_m(double from_s, double to_s) const;
  /// Whether a body is elsewhere or moves at another velocity at the second time: one that starts there has its
  /// velocity already, but is still where it was.
  bool change(double from_s, double to_s) const;

  /// Calls visit(wall, position, velocity) for every particle of a body that moves; `wall` is its place in
  /// Scene::walls.
  template <class Visit>
  void for_each(double t_s, Visit&& visit) const {
    for (const Particle& p : particles_) {
      const RigidMotion& motion = motions_[p.motion];
      visit(p.wall, p.start + motion.displacement_m(t_s), motion.velocity_at(t_s));
    }
  }

 private:
  struct Particle {
    Vec3d start;
    std::int32_t wall;
    std::uint32_t motion;
  };
  std::vector<RigidMotion> motions_;
  std::vector<Particle> particles_;
};

}  // namespace sluice
