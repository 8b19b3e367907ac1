#include "reports/snapshot_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sluice {

namespace {

// What is farther (larger y) is drawn to the right and upwards.
constexpr double right_by_depth = 0.38;
constexpr double up_by_depth = 0.27;
constexpr std::uint32_t dry_wall = 0xB9C2C8;

std::vector<Box> obstacles_at(const Case& the_case, double t_s) {
  std::vector<Box> boxes;
  for (const Obstacle& obstacle : the_case.obstacles)
    if (const auto box = obstacle_at(obstacle, t_s, the_case.tank)) boxes.push_back(*box);
  return boxes;
}

bool in_obstacle(const Vec3d& p, const std::vector<Box>& boxes, double margin) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
    return p.x > b.lower.x - margin && p.x < b.upper.x + margin && p.y > b.lower.y - margin &&
           p.y < b.upper.y + margin && p.z > b.lower.z && p.z < b.upper.z + margin;
  });
}

/// Which parts of the drawing are covered already, in square cells of a third of a disc.
class Cover {
 public:
  explicit Cover(double disc) : cell_(disc / 3), columns_(static_cast<int>(8.0 / cell_)) {
    taken_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_), false);
  }

  /// Takes the 3 x 3 cells around a point; false when all of them were taken before.
  bool take(double x, double y) {
    const int i = static_cast<int>(std::lround((x + 1) / cell_));
    const int j = static_cast<int>(std::lround((y + 1) / cell_));
    bool seen = false;
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj) {
        if (i + di < 0 || j + dj < 0 || i + di >= columns_ || j + dj >= columns_) continue;
        auto cell = taken_[static_cast<std::size_t>(j + dj) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(i + di)];
        seen = seen || !cell;
        cell = true;
      }
    return seen;
  }

 private:
  double cell_;
  int columns_;
  std::vector<bool> taken_;
};

Vec3d position(const ParticleSnapshot& snapshot, std::size_t i) {
  const auto& p = snapshot.position_m[i];
  return {p.x, p.y, p.z};
}

}  // namespace

std::pair<double, double> project(const Vec3d& point) {
  return {point.x + right_by_depth * point.y, point.z + up_by_depth * point.y};
}

double depth(const Vec3d& point) {
  return point.y - right_by_depth * point.x - up_by_depth * point.z;
}

std::uint32_t viridis(double share) {
  static constexpr std::array<std::array<double, 3>, 10> stops = {{{0x44, 0x01, 0x54},
                                                                   {0x48, 0x28, 0x78},
                                                                   {0x3E, 0x49, 0x89},
                                                                   {0x31, 0x68, 0x8E},
                                                                   {0x26, 0x82, 0x8E},
                                                                   {0x1F, 0x9E, 0x89},
                                                                   {0x35, 0xB7, 0x79},
                                                                   {0x6E, 0xCE, 0x58},
                                                                   {0xB5, 0xDE, 0x2B},
                                                                   {0xFD, 0xE7, 0x25}}};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(at), stops.size() - 2);
  std::uint32_t colour = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = stops[low][k] + (at - static_cast<double>(low)) * (stops[low + 1][k] - stops[low][k]);
    colour = colour << 8 | static_cast<std::uint32_t>(std::lround(value));
  }
  return colour;
}

namespace {

/// Shares of the colour scale, particle by particle.
class Shares {
 public:
  Shares(const ParticleSnapshot& snapshot, const Case& the_case, ParticleColour colour)
      : snapshot_(snapshot), of_(colour.of) {
    const double g_m_s2 = std::sqrt(dot(the_case.gravity_m_s2, the_case.gravity_m_s2));
    pressure_Pa_ = the_case.density_kg_m3 * g_m_s2 * the_case.water_height_m * colour.largest;
    speed_m_s_ = std::sqrt(g_m_s2 * the_case.water_height_m) * colour.largest;
  }

  double operator()(std::size_t i) const {
    if (of_ == ParticleColour::Of::pressure)
      return i < snapshot_.pressure_Pa.size() ? snapshot_.pressure_Pa[i] / pressure_Pa_ : 0;
    if (i >= snapshot_.velocity_m_s.size()) return 0;
    const auto& u = snapshot_.velocity_m_s[i];
    return std::hypot(u.x, u.y, u.z) / speed_m_s_;
  }

 private:
  const ParticleSnapshot& snapshot_;
  ParticleColour::Of of_;
  double pressure_Pa_ = 0;
  double speed_m_s_ = 0;
};

}  // namespace

std::optional<Box> obstacle_at(const Obstacle& obstacle, double t_s, const Box& tank) {
  if (!obstacle.motion.moves()) return obstacle.box;
  Box box = shifted(obstacle.box, obstacle.motion.displacement_m(t_s));
  box.upper.z = std::min(box.upper.z, tank.upper.z);
  if (box.lower.z >= box.upper.z) return std::nullopt;
  return box;
}

std::vector<SnapshotDisc> snapshot_discs(const ParticleSnapshot& snapshot, const Case& the_case, double l0_m,
                                         ParticleColour colour) {
  const std::vector<Box> obstacles = obstacles_at(the_case, snapshot.time_s);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < snapshot.position_m.size(); ++i)
    if (i < snapshot.fluid_count || in_obstacle(position(snapshot, i), obstacles, 0.5 * l0_m)) shown.push_back(i);
  std::sort(shown.begin(), shown.end(),
            [&](std::size_t a, std::size_t b) { return depth(position(snapshot, a)) < depth(position(snapshot, b)); });
  Cover cover(l0_m);
  const Shares share(snapshot, the_case, colour);
  std::vector<SnapshotDisc> discs;
  for (std::size_t i : shown) {
    const auto [x, y] = project(position(snapshot, i));
    if (!cover.take(x, y)) continue;
    const bool wall = i >= snapshot.fluid_count;
    const bool grey = wall && (colour.of == ParticleColour::Of::velocity || share(i) <= 0);
    discs.push_back({static_cast<float>(x), static_cast<float>(y), grey ? dry_wall : viridis(share(i))});
  }
  std::reverse(discs.begin(), discs.end());
  return discs;
}

std::vector<std::pair<std::pair<double, double>, std::pair<double, double>>> box_edges(const Box& box) {
  auto corner = [&](int bits) {
    return project({bits & 1 ? box.upper.x : box.lower.x, bits & 2 ? box.upper.y : box.lower.y,
                    bits & 4 ? box.upper.z : box.lower.z});
  };
  std::vector<std::pair<std::pair<double, double>, std::pair<double, double>>> edges;
  for (int from = 0; from < 8; ++from)
    for (int axis : {1, 2, 4})
      if ((from & axis) == 0) edges.emplace_back(corner(from), corner(from | axis));
  return edges;
}

}  // namespace sluice
