#include "solvers/scene_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sluice {
namespace {

/// A plate of so many particles keeps the fluid on its two sides, 4 l0 apart, out of each other's reach (3 l0), and
/// gives either side a wall layer of its own.
constexpr std::int64_t least_plate_cells = 3;

}  // namespace

bool CellBox::contains(const Index3& c) const {
  for (int a = 0; a < 3; ++a) {
    if (c[a] < lower[a] || c[a] >= upper[a]) return false;
  }
  return true;
}

CellBox CellBox::grown(std::int64_t n) const {
  CellBox g = *this;
  for (int a = 0; a < 3; ++a) {
    g.lower[a] -= n;
    g.upper[a] += n;
  }
  return g;
}

CellBox CellBox::shared_with(const CellBox& o) const {
  CellBox s;
  for (int a = 0; a < 3; ++a) {
    s.lower[a] = std::max(lower[a], o.lower[a]);
    s.upper[a] = std::max(s.lower[a], std::min(upper[a], o.upper[a]));
  }
  return s;
}

double CellBox::cells() const {
  double n = 1;
  for (int a = 0; a < 3; ++a) n *= static_cast<double>(upper[a] - lower[a]);
  return n;
}

SceneLattice::SceneLattice(const SceneDescription& d) : d_(d), l0_(d.particle_distance_m) {
  if (!(l0_ > 0) || !std::isfinite(l0_)) throw std::invalid_argument("particle distance must be a positive length");
  if (d.wall_layers < 1) throw std::invalid_argument("a scene needs at least one layer of wall particles");
  tank_ = nearest(d.tank, "tank");
  for (std::size_t k = 0; k < d.fluid.size(); ++k)
    fluid_.push_back(best_volume(d.fluid[k], fmt::format("fluid[{}]", k)));
  for (std::size_t k = 0; k < d.obstacles.size(); ++k)
    obstacles_.push_back(nearest_obstacle(k, fmt::format("obstacle[{}]", k)));
  refuse_shared_cells();
}

Vec3d SceneLattice::centre(const Index3& c) const {
  const Vec3d& o = d_.tank.lower;
  return {o.x + (static_cast<double>(c[0]) + 0.5) * l0_, o.y + (static_cast<double>(c[1]) + 0.5) * l0_,
          o.z + (static_cast<double>(c[2]) + 0.5) * l0_};
}

Box SceneLattice::box(const CellBox& c) const {
  Box b;
  for (int a = 0; a < 3; ++a) {
    const double origin = component(d_.tank.lower, a);
    component(b.lower, a) = origin + static_cast<double>(c.lower[a]) * l0_;
    component(b.upper, a) = origin + static_cast<double>(c.upper[a]) * l0_;
  }
  return b;
}

double SceneLattice::in_cells(double x_m, int axis) const {
  return (x_m - component(d_.tank.lower, axis)) / l0_;
}

void SceneLattice::require_cells(const CellBox& c, const std::string& name) const {
  for (int a = 0; a < 3; ++a) {
    if (c.upper[a] > c.lower[a]) continue;
    throw std::invalid_argument(
        fmt::format("{} is thinner than half a particle distance in {} at l0 = {} m: choose a smaller l0", name,
                    axis_name(a), l0_));
  }
}

CellBox SceneLattice::rounded(const Box& b) const {
  CellBox c;
  for (int a = 0; a < 3; ++a) {
    c.lower[a] = std::llround(in_cells(component(b.lower, a), a));
    c.upper[a] = std::llround(in_cells(component(b.upper, a), a));
  }
  return c;
}

CellBox SceneLattice::nearest(const Box& b, const std::string& name) const {
  const CellBox c = rounded(b);
  require_cells(c, name);
  return c;
}

CellBox SceneLattice::nearest_obstacle(std::size_t k, const std::string& name) const {
  const Obstacle& o = d_.obstacles[k];
  if (!o.thin) return nearest(o.box, name);
  CellBox c = rounded(o.box);
  for (int a = 0; a < 3; ++a)
    if (c.upper[a] - c.lower[a] < least_plate_cells) thicken(c, k, a);
  return c;
}

/// Of all places for a plate of the least thickness, the one that takes least of the space of the fluid and of other
/// obstacles, and of those the one whose faces move least.
void SceneLattice::thicken(CellBox& plate, std::size_t k, int axis) const {
  const Box& nominal = d_.obstacles[k].box;
  const double lower = in_cells(component(nominal.lower, axis), axis);
  const double upper = in_cells(component(nominal.upper, axis), axis);
  CellBox best = plate;
  double least = std::numeric_limits<double>::infinity();
  const std::int64_t first = plate.lower[axis] - least_plate_cells;
  for (std::int64_t from = first; from <= plate.upper[axis]; ++from) {
    CellBox tried = plate;
    tried.lower[axis] = from;
    tried.upper[axis] = from + least_plate_cells;
    if (static_cast<double>(tried.lower[axis]) > lower + 0.5 || static_cast<double>(tried.upper[axis]) < upper - 0.5)
      continue;
    const double moved = std::abs(static_cast<double>(tried.lower[axis]) - lower) +
                         std::abs(static_cast<double>(tried.upper[axis]) - upper);
    const double cost = moved + 1e3 * cells_taken(tried, k);
    if (cost >= least) continue;
    least = cost;
    best = tried;
  }
  plate = best;
}

double SceneLattice::cells_taken(const CellBox& plate, std::size_t k) const {
  double cells = 0;
  for (const CellBox& f : fluid_) cells += plate.shared_with(f).cells();
  for (std::size_t other = 0; other < d_.obstacles.size(); ++other)
    if (other != k) cells += plate.shared_with(rounded(d_.obstacles[other].box)).cells();
  return cells;
}

/// Particles of two walls in one place would push twice, and lie at no distance from each other.
void SceneLattice::refuse_shared_cells() const {
  for (std::size_t k = 0; k < obstacles_.size(); ++k)
    for (std::size_t other = 0; other < k; ++other) {
      if (!(obstacles_[k].shared_with(obstacles_[other]).cells() > 0)) continue;
      throw std::invalid_argument(fmt::format(
          "{} and {} share space on the lattice at l0 = {} m, where a thin one is {} particles thick: choose "
          "a smaller l0, or draw them further apart",
          called(d_.obstacles[other], other), called(d_.obstacles[k], k), l0_, least_plate_cells));
    }
}

/// Faces that lie on the tank follow the tank; free faces go down or up to a lattice plane, whichever combination
/// keeps volume and lengths best: the sum of the volume's and of the largest length's relative deviation is least.
CellBox SceneLattice::best_volume(const Box& b, const std::string& name) const {
  CellBox best;
  double least = std::numeric_limits<double>::infinity();
  for (int choice = 0; choice < 64; ++choice) {
    const CellBox c = faces(b, choice);
    const double deviation = std::abs(c.cells() * l0_ * l0_ * l0_ / volume(b) - 1);
    double worst = 0;
    for (int a = 0; a < 3; ++a) {
      const double nominal = component(b.upper, a) - component(b.lower, a);
      worst = std::max(worst, std::abs(static_cast<double>(c.upper[a] - c.lower[a]) * l0_ / nominal - 1));
    }
    if (deviation + worst < least - same_length_m) {
      least = deviation + worst;
      best = c;
    }
  }
  require_cells(best, name);
  return best;
}

/// Bits of `choice`: whether each of the six faces goes up.
CellBox SceneLattice::faces(const Box& b, int choice) const {
  CellBox c;
  for (int a = 0; a < 3; ++a) {
    c.lower[a] = face(component(b.lower, a), a, (choice >> a) & 1);
    c.upper[a] = face(component(b.upper, a), a, (choice >> (a + 3)) & 1);
  }
  return c;
}

std::int64_t SceneLattice::face(double x_m, int axis, bool up) const {
  if (std::abs(x_m - component(d_.tank.lower, axis)) < same_length_m) return tank_.lower[axis];
  if (std::abs(x_m - component(d_.tank.upper, axis)) < same_length_m) return tank_.upper[axis];
  const double cells = in_cells(x_m, axis);
  if (std::abs(cells - std::round(cells)) * l0_ < same_length_m) return std::llround(cells);
  return static_cast<std::int64_t>(up ? std::ceil(cells) : std::floor(cells));
}

}  // namespace sluice
