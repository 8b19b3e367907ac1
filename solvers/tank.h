// Where fluid may be: inside the tank or above it, outside the obstacles. Tells particles that left over the open top
// from those that passed through a wall.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/scene.h"

namespace sluice {

/// `undefined`: the position is not a number.
enum class Whereabouts : std::uint8_t { inside = 0, over_top = 1, through_wall = 2, undefined = 3 };

class Tank {
  /// An obstacle where it is now.
  struct Solid {
    Box core;                 ///< shrunk by the tolerance at its wet faces
    Box skin;                 ///< shrunk by half the tolerance
    bool has_bottom = false;  ///< fluid can be under it
    RigidMotion motion;
    Vec3d displacement_m{};
    Vec3d velocity_m_s{};
  };

 public:
  explicit Tank(const Scene& scene);

  /// Takes the obstacles that move to where they are at a time.
  void move_obstacles(double t_s);

  /// A particle has passed through a wall when its centre lies deeper than one particle distance behind the face. It
  /// has left over the top when it is beyond the walls at their upper edge, or half the tank's height above the tank.
  /// The edge begins three particle distances below the rim, a kernel radius: there the walls' particles end, and what
  /// runs up to it spills.
  Whereabouts whereabouts(const Vec3d& position_m) const;

  /// Walls are impermeable: a particle whose centre is between half and one particle distance behind a face is set back
  /// to half of one, and loses its velocity into the wall (relative to it, where it moves). Returns whether it was.
  /// Bodies count one by one: where two touch, nothing is held or counted in a slot as wide as a particle distance
  /// around their common face; there the walls' pressures alone keep fluid out.
  bool hold(Vec3d& p_m, Vec3d& u_m_s) const;

  /// Holds every wall particle, on all its way, and all positions that are `inside` with one particle distance to
  /// spare.
  const Box& domain() const { return domain_; }

  /// The face of the tank or of an obstacle at rest on which a point lies (the nearest one).
  struct Face {
    int axis = 0;  ///< 0 x, 1 y, 2 z
    double coordinate_m = 0;
  };
  Face nearest_face(const Vec3d& point_m) const;

 private:
  Box inside_;    ///< tank grown by the tolerance, up to the domain's top
  double rim_m_;  ///< where the upper edge of the walls begins
  std::vector<Solid> solids_;
  double half_m_;            ///< half a particle distance
  std::vector<Box> bodies_;  ///< fitted tank and the obstacles that do not move
  Box domain_;
};

}  // namespace sluice
