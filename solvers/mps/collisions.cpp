#include "solvers/mps/collisions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

/// Wall particles within this many particle distances share in the normal at a fluid particle, the nearer the more: far
/// enough for four of them at least, near enough that an edge is felt as an edge.
constexpr double normal_support_over_distance = 1.3;

struct Distances {
  double pair_m;
  double wall_m;
  double support_m;

  explicit Distances(const Parameters& p)
      : pair_m(p.collision_over_distance * p.particle_distance_m),
        wall_m(p.wall_contact_over_distance * p.particle_distance_m),
        support_m(normal_support_over_distance * p.particle_distance_m) {}
};

/// The wall as a fluid particle meets it.
struct WallAhead {
  Vec3d normal;
  double gap_m = std::numeric_limits<double>::infinity();  ///< along a normal to the layer's particles
  double shares = 0;
  Vec3d velocity_m_s;  ///< of the wall, times the sum of shares

  void add(const Vec3d& r, const Vec3d& wall_normal, const Vec3d& wall_velocity, double support_m) {
    const double share = support_m - std::sqrt(dot(r, r));
    if (share <= 0) return;
    normal += share * wall_normal;
    shares += share;
    velocity_m_s += share * wall_velocity;
    gap_m = std::min(gap_m, -dot(r, wall_normal));
  }

  /// Takes away the velocity into the wall where the particle would come too near.
  Vec3d contact(const Vec3d& velocity, double wall_m, double dt_s) const {
    const double length = std::sqrt(dot(normal, normal));
    if (length == 0 || wall_m <= 0) return {};
    const Vec3d n = (1 / length) * normal;
    const double into = dot(velocity - (1 / shares) * velocity_m_s, n);
    if (into >= 0 || gap_m + dt_s * into >= wall_m) return {};
    return -into * n;
  }
};

/// Change of the velocity of one fluid particle   [m/s]
template <class Pack>
Vec3d velocity_change(const Particles<Pack>& p, const VectorField<double>& wall_normals,
                      const NeighbourList<Pack>& list, const OperatorConstants& c, const Distances& d, std::size_t i) {
  const Vec3d x = p.position.template at<double>(i);
  const Vec3d u = p.velocity.template at<double>(i);
  Vec3d change;
  WallAhead wall;
  const Span span = list.near().span(i);
  for (std::uint32_t at = span.begin; at < span.end; ++at) {
    const auto j = static_cast<std::size_t>(list.near().columns()[at]);
    const Vec3d r = p.position.template at<double>(j) - x;
    if (!p.is_fluid(j)) {
      wall.add(r, wall_normals.at<double>(j - p.first_wall()), p.velocity.template at<double>(j), d.support_m);
      continue;
    }
    const Vec3d relative = p.velocity.template at<double>(j) - u;
    const Vec3d ahead = r + c.dt_s * relative;
    if (dot(ahead, ahead) <= d.pair_m * d.pair_m) change += collision_term(relative, r, c.parameters.restitution, 0.5);
  }
  return change + wall.contact(u + change, d.wall_m, c.dt_s);
}

/// Sum of the unit vectors to wall particle w from what solid is not its own and lies within `support_m`.
template <class Pack>
Vec3d away_from_solids(const Particles<Pack>& p, const SolidSets& solids, std::size_t w, double support_m) {
  const Vec3d x = p.position.template at<double>(p.first_wall() + w);
  Vec3d sum;
  const auto add = [&](std::size_t j) {
    const Vec3d r = p.position.template at<double>(j) - x;
    if (const double distance2 = dot(r, r); distance2 < support_m * support_m) sum += (-1 / std::sqrt(distance2)) * r;
  };
  for (const Run& run : solids.dummies.neighbours(x, 0.0))
    for (auto j = static_cast<std::size_t>(run.begin); j < static_cast<std::size_t>(run.end); ++j) add(j);
  if (solids.moving_body.empty()) return sum;
  for (const Run& run : solids.walls.neighbours(x, 0.0))
    for (auto k = static_cast<std::size_t>(run.begin); k < static_cast<std::size_t>(run.end); ++k)
      if (solids.moving_body[k] != solids.moving_body[w]) add(p.first_wall() + k);
  return sum;
}

}  // namespace

/// No pair comes closer by more than 2 Cr l0 in a step.
double collision_reach_m(const Parameters& p) {
  const Distances d(p);
  return std::max(d.pair_m, d.support_m) + 2 * p.courant * p.particle_distance_m;
}

template <class Pack>
std::int64_t collide(const Particles<Pack>& p, const VectorField<double>& wall_normals, const NeighbourList<Pack>& list,
                     const OperatorConstants& c, VectorField<typename Lanes<Pack>::Real>& after, int threads) {
  const Distances distances(c.parameters);
  const auto n = static_cast<std::int64_t>(p.size());
  std::int64_t collided = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(+ : collided)
  for (auto k = static_cast<std::int64_t>(p.first_fluid()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3d change = velocity_change(p, wall_normals, list, c, distances, i);
    after.set(i, p.velocity.template at<double>(i) + change);
    collided += dot(change, change) > 0;
  }
  return collided;
}

template <class Pack>
void find_wall_normals(const Particles<Pack>& p, const SolidSets& solids, double particle_distance_m, const Box& moved,
                       int threads, VectorField<double>& normals) {
  const double support_m = 1.75 * particle_distance_m;  // the layer behind, with its corners
  const Box within = grown(moved, support_m);
  const auto n = static_cast<std::int64_t>(p.walls);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 256)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto w = static_cast<std::size_t>(k);
    if (!holds_point(within, p.position.template at<double>(p.first_wall() + w))) continue;
    const Vec3d sum = away_from_solids(p, solids, w, support_m);
    const double length = std::sqrt(dot(sum, sum));
    normals.set(w, length > 0 ? (1 / length) * sum : sum);
  }
}

template std::int64_t collide(const Particles<double>&, const VectorField<double>&, const NeighbourList<double>&,
                              const OperatorConstants&, VectorField<double>&, int);
template std::int64_t collide(const Particles<FloatPack>&, const VectorField<double>&, const NeighbourList<FloatPack>&,
                              const OperatorConstants&, VectorField<float>&, int);
template void find_wall_normals(const Particles<double>&, const SolidSets&, double, const Box&, int,
                                VectorField<double>&);
template void find_wall_normals(const Particles<FloatPack>&, const SolidSets&, double, const Box&, int,
                                VectorField<double>&);

}  // namespace sluice::mps
