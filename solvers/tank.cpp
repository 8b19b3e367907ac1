#include "solvers/tank.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice {
namespace {

/// Shrinks an obstacle; where it stands on the tank for good it reaches a particle distance into the tank's wall
/// instead, as deep as a particle can be that is not lost, so that nothing creeps in between. The tank's top is no
/// wall.
Box shrunk(const Obstacle& o, const Box& tank, double by_m, double l0) {
  Box b = o.box;
  const bool moves = o.motion.moves();
  for (int a = 0; a < 3; ++a) {
    double& lower = component(b.lower, a);
    double& upper = component(b.upper, a);
    lower += moves || lower > component(tank.lower, a) ? by_m : -l0;
    upper -= moves || a == 2 || upper < component(tank.upper, a) ? by_m : -l0;
  }
  return b;
}

/// Moves a point inside a box to its nearest side, top, or bottom where it `has_bottom`, and takes the velocity into
/// the box.
void push_out(const Box& b, bool has_bottom, Vec3d& p, Vec3d& u) {
  const double x = std::min(p.x - b.lower.x, b.upper.x - p.x);
  const double y = std::min(p.y - b.lower.y, b.upper.y - p.y);
  const double z = has_bottom ? std::min(p.z - b.lower.z, b.upper.z - p.z) : b.upper.z - p.z;
  const auto to_side = [](double& c, double& v, double lower, double upper) {
    const bool low = c - lower < upper - c;
    v = low ? std::min(0.0, v) : std::max(0.0, v);
    c = low ? lower : upper;
  };
  if (z <= x && z <= y) {
    to_side(p.z, u.z, has_bottom ? b.lower.z : -std::numeric_limits<double>::infinity(), b.upper.z);
  } else if (x <= y) {
    to_side(p.x, u.x, b.lower.x, b.upper.x);
  } else {
    to_side(p.y, u.y, b.lower.y, b.upper.y);
  }
}

/// u where a body of velocity v has taken nothing of u - v (`was`, `now`): the sum of both could differ in its last
/// digit.
Vec3d with_taken(const Vec3d& u, const Vec3d& was, const Vec3d& now, const Vec3d& v) {
  return {now.x == was.x ? u.x : now.x + v.x, now.y == was.y ? u.y : now.y + v.y, now.z == was.z ? u.z : now.z + v.z};
}

}  // namespace

Tank::Tank(const Scene& scene)
    : inside_(scene.fitted.tank), rim_m_(scene.fitted.tank.upper.z - 3 * scene.description.particle_distance_m) {
  const double l0 = scene.description.particle_distance_m;
  const Box& tank = scene.fitted.tank;
  inside_.lower = inside_.lower - Vec3d{l0, l0, l0};
  inside_.upper = {tank.upper.x + l0, tank.upper.y + l0, fluid_ceiling_m(tank)};
  half_m_ = 0.5 * l0;
  const double margin = (scene.description.wall_layers + 1) * l0;
  domain_ = {tank.lower - Vec3d{margin, margin, margin}, tank.upper + Vec3d{margin, margin, 0}};
  domain_.upper.z = inside_.upper.z + l0;
  bodies_.push_back(tank);
  for (const Obstacle& o : scene.fitted.obstacles) {
    const bool has_bottom = o.motion.moves() || o.box.lower.z > tank.lower.z;
    solids_.push_back({shrunk(o, tank, l0, l0), shrunk(o, tank, half_m_, l0), has_bottom, o.motion});
    if (!o.motion.moves()) {
      bodies_.push_back(o.box);
      continue;
    }
    const Vec3d spare{l0, l0, l0};
    const Box end = shifted(o.box, o.motion.displacement_m(o.motion.stop_s));
    domain_ = around(domain_, {end.lower - spare, end.upper + spare});
  }
  move_obstacles(0);
}

void Tank::move_obstacles(double t_s) {
  for (Solid& s : solids_) {
    s.displacement_m = s.motion.displacement_m(t_s);
    s.velocity_m_s = s.motion.velocity_at(t_s);
  }
}

Whereabouts Tank::whereabouts(const Vec3d& p) const {
  if (holds_inside(inside_, p)) {
    for (const Solid& s : solids_) {
      if (holds_inside(s.core, p - s.displacement_m)) return Whereabouts::through_wall;
    }
    return Whereabouts::inside;
  }
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return Whereabouts::undefined;
  return p.z > rim_m_ ? Whereabouts::over_top : Whereabouts::through_wall;
}

bool Tank::hold(Vec3d& p, Vec3d& u) const {
  bool held = false;
  const auto keep = [&](double& x, double& v, double lower, double upper) {
    if (x >= lower && x <= upper) return;
    v = x < lower ? std::max(0.0, v) : std::min(0.0, v);
    x = std::clamp(x, lower, upper);
    held = true;
  };
  const Box& tank = bodies_.front();
  if (p.z < rim_m_ && holds_inside(inside_, p)) {
    keep(p.x, u.x, tank.lower.x - half_m_, tank.upper.x + half_m_);
    keep(p.y, u.y, tank.lower.y - half_m_, tank.upper.y + half_m_);
    keep(p.z, u.z, tank.lower.z - half_m_, inside_.upper.z);
  }
  for (const Solid& s : solids_) {
    Vec3d relative = p - s.displacement_m;
    if (!holds_inside(s.skin, relative) || holds_inside(s.core, relative)) continue;
    const Vec3d velocity = u - s.velocity_m_s;
    Vec3d held_velocity = velocity;
    push_out(s.skin, s.has_bottom, relative, held_velocity);
    p = relative + s.displacement_m;
    u = with_taken(u, velocity, held_velocity, s.velocity_m_s);
    held = true;
  }
  return held;
}

Tank::Face Tank::nearest_face(const Vec3d& p) const {
  Face nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Box& b : bodies_) {
    // A face counts by its plane's distance, plus how far the point lies beside the face.
    const auto beside = [](double x, double lower, double upper) { return std::max({0.0, lower - x, x - upper}); };
    const Vec3d off{beside(p.x, b.lower.x, b.upper.x), beside(p.y, b.lower.y, b.upper.y),
                    beside(p.z, b.lower.z, b.upper.z)};
    const auto consider = [&](int axis, double coordinate, double x, double off_face) {
      const double distance = std::abs(x - coordinate) + off_face;
      if (distance < least) {
        least = distance;
        nearest = {axis, coordinate};
      }
    };
    for (const bool upper : {false, true}) {
      const Vec3d& corner = upper ? b.upper : b.lower;
      consider(0, corner.x, p.x, off.y + off.z);
      consider(1, corner.y, p.y, off.x + off.z);
      consider(2, corner.z, p.z, off.x + off.y);
    }
  }
  return nearest;
}

}  // namespace sluice
