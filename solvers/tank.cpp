#include "solvers/tank.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice {
namespace {

bool contains(const Box& b, const Vec3d& p) {
  return p.x > b.lower.x && p.x < b.upper.x && p.y > b.lower.y && p.y < b.upper.y && p.z > b.lower.z && p.z < b.upper.z;
}

/// Shrinks an obstacle by the tolerance except where it stands on the tank.
Box core(Box b, const Box& tank, double tolerance) {
  const auto shrink = [&](double& lower, double& upper, double tank_lower, double tank_upper) {
    lower += lower > tank_lower ? tolerance : -tolerance;
    upper -= upper < tank_upper ? tolerance : -tolerance;
  };
  shrink(b.lower.x, b.upper.x, tank.lower.x, tank.upper.x);
  shrink(b.lower.y, b.upper.y, tank.lower.y, tank.upper.y);
  shrink(b.lower.z, b.upper.z, tank.lower.z, tank.upper.z);
  return b;
}

/// Moves a point inside a box to its nearest side or top, and takes the velocity into the box.
bool push_out(const Box& b, Vec3d& p, Vec3d& u) {
  const double x = std::min(p.x - b.lower.x, b.upper.x - p.x);
  const double y = std::min(p.y - b.lower.y, b.upper.y - p.y);
  const double z = b.upper.z - p.z;
  const auto to_side = [](double& c, double& v, double lower, double upper) {
    const bool low = c - lower < upper - c;
    v = low ? std::min(0.0, v) : std::max(0.0, v);
    c = low ? lower : upper;
  };
  if (z <= x && z <= y) {
    p.z = b.upper.z;
    u.z = std::max(0.0, u.z);
  } else if (x <= y) {
    to_side(p.x, u.x, b.lower.x, b.upper.x);
  } else {
    to_side(p.y, u.y, b.lower.y, b.upper.y);
  }
  return true;
}

}  // namespace

Tank::Tank(const Scene& scene)
    : inside_(scene.fitted.tank), rim_m_(scene.fitted.tank.upper.z - 3 * scene.description.particle_distance_m) {
  const double l0 = scene.description.particle_distance_m;
  const Box& tank = scene.fitted.tank;
  inside_.lower = inside_.lower - Vec3d{l0, l0, l0};
  inside_.upper = inside_.upper + Vec3d{l0, l0, 0.5 * (tank.upper.z - tank.lower.z)};
  half_m_ = 0.5 * l0;
  for (const Box& o : scene.fitted.obstacles) skin_.push_back(core(o, tank, half_m_));
  for (const Box& o : scene.fitted.obstacles) solid_.push_back(core(o, tank, l0));
  bodies_.push_back(tank);
  bodies_.insert(bodies_.end(), scene.fitted.obstacles.begin(), scene.fitted.obstacles.end());
  const double margin = (scene.description.wall_layers + 1) * l0;
  domain_ = {tank.lower - Vec3d{margin, margin, margin}, tank.upper + Vec3d{margin, margin, 0}};
  domain_.upper.z = inside_.upper.z + l0;
}

Whereabouts Tank::whereabouts(const Vec3d& p) const {
  if (contains(inside_, p)) {
    for (const Box& o : solid_) {
      if (contains(o, p)) return Whereabouts::through_wall;
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
  if (p.z < rim_m_ && contains(inside_, p)) {
    keep(p.x, u.x, tank.lower.x - half_m_, tank.upper.x + half_m_);
    keep(p.y, u.y, tank.lower.y - half_m_, tank.upper.y + half_m_);
    keep(p.z, u.z, tank.lower.z - half_m_, inside_.upper.z);
  }
  for (std::size_t k = 0; k < skin_.size(); ++k) {
    if (contains(skin_[k], p) && !contains(solid_[k], p)) held = push_out(skin_[k], p, u) || held;
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
