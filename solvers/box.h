// Axis-parallel boxes.
#pragma once

#include <algorithm>

#include "solvers/vec3.h"

namespace sluice {

/// An axis-parallel box [m].
struct Box {
  Vec3d lower;
  Vec3d upper;
};

/// Whether a point lies in a box or on its faces.
inline bool holds_point(const Box& b, const Vec3d& p) {
  return p.x >= b.lower.x && p.x <= b.upper.x && p.y >= b.lower.y && p.y <= b.upper.y && p.z >= b.lower.z &&
         p.z <= b.upper.z;
}

/// Whether a point lies in a box and not on its faces.
inline bool holds_inside(const Box& b, const Vec3d& p) {
  return p.x > b.lower.x && p.x < b.upper.x && p.y > b.lower.y && p.y < b.upper.y && p.z > b.lower.z && p.z < b.upper.z;
}

/// Drawn lengths that differ by no more are the same: they are given to a tenth of a millimetre at best.
inline constexpr double drawn_tolerance_m = 1e-6;

/// A box with every face moved outwards.
inline Box grown(const Box& b, double by_m) {
  const Vec3d by{by_m, by_m, by_m};
  return {b.lower - by, b.upper + by};
}

/// Whether two boxes have more than a face in common.
inline bool share_volume(const Box& a, const Box& b) {
  constexpr double e = drawn_tolerance_m;
  return a.lower.x < b.upper.x - e && b.lower.x < a.upper.x - e && a.lower.y < b.upper.y - e &&
         b.lower.y < a.upper.y - e && a.lower.z < b.upper.z - e && b.lower.z < a.upper.z - e;
}

inline double longest_edge(const Box& b) {
  return std::max({b.upper.x - b.lower.x, b.upper.y - b.lower.y, b.upper.z - b.lower.z});
}

inline double volume(const Box& b) {
  return (b.upper.x - b.lower.x) * (b.upper.y - b.lower.y) * (b.upper.z - b.lower.z);
}

inline Box shifted(const Box& b, const Vec3d& by) {
  return {b.lower + by, b.upper + by};
}

/// The smallest box around two.
inline Box around(const Box& a, const Box& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y), std::min(a.lower.z, b.lower.z)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y), std::max(a.upper.z, b.upper.z)}};
}

}  // namespace sluice
