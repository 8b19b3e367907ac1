#include "solvers/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sluice {
namespace {

using Index3 = std::array<std::int64_t, 3>;

/// A box in lattice cells: first cell and one past the last.
struct CellBox {
  Index3 lower{};
  Index3 upper{};

  bool contains(const Index3& c) const {
    for (int a = 0; a < 3; ++a) {
      if (c[a] < lower[a] || c[a] >= upper[a]) return false;
    }
    return true;
  }
  CellBox grown(std::int64_t n) const {
    CellBox g = *this;
    for (int a = 0; a < 3; ++a) {
      g.lower[a] -= n;
      g.upper[a] += n;
    }
    return g;
  }
  double cells() const {
    double n = 1;
    for (int a = 0; a < 3; ++a) n *= static_cast<double>(upper[a] - lower[a]);
    return n;
  }
};

double component(const Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
double& component(Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
constexpr char axis_name(int axis) {
  return static_cast<char>('x' + axis);
}
constexpr double same_length_m = 1e-9;

double volume(const Box& b) {
  return (b.upper.x - b.lower.x) * (b.upper.y - b.lower.y) * (b.upper.z - b.lower.z);
}

/// The lattice of a scene: cell (0, 0, 0) begins at the tank's lower corner.
class Lattice {
 public:
  explicit Lattice(const SceneDescription& d) : d_(d), l0_(d.particle_distance_m) {
    if (!(l0_ > 0) || !std::isfinite(l0_)) throw std::invalid_argument("particle distance must be a positive length");
    if (d.wall_layers < 1) throw std::invalid_argument("a scene needs at least one layer of wall particles");
    tank_ = nearest(d.tank, "tank");
    for (std::size_t k = 0; k < d.fluid.size(); ++k)
      fluid_.push_back(best_volume(d.fluid[k], fmt::format("fluid[{}]", k)));
    for (std::size_t k = 0; k < d.obstacles.size(); ++k) {
      obstacles_.push_back(nearest(d.obstacles[k], fmt::format("obstacle[{}]", k)));
    }
  }

  const CellBox& tank() const { return tank_; }
  const std::vector<CellBox>& fluid() const { return fluid_; }
  const std::vector<CellBox>& obstacles() const { return obstacles_; }

  Vec3d centre(const Index3& c) const {
    const Vec3d& o = d_.tank.lower;
    return {o.x + (static_cast<double>(c[0]) + 0.5) * l0_, o.y + (static_cast<double>(c[1]) + 0.5) * l0_,
            o.z + (static_cast<double>(c[2]) + 0.5) * l0_};
  }

  Box box(const CellBox& c) const {
    Box b;
    for (int a = 0; a < 3; ++a) {
      const double origin = component(d_.tank.lower, a);
      component(b.lower, a) = origin + static_cast<double>(c.lower[a]) * l0_;
      component(b.upper, a) = origin + static_cast<double>(c.upper[a]) * l0_;
    }
    return b;
  }

 private:
  double in_cells(double x_m, int axis) const { return (x_m - component(d_.tank.lower, axis)) / l0_; }

  static void require_cells(const CellBox& c, const std::string& name, double l0) {
    for (int a = 0; a < 3; ++a) {
      if (c.upper[a] > c.lower[a]) continue;
      throw std::invalid_argument(
          fmt::format("{} is thinner than half a particle distance in {} at l0 = {} m: choose a smaller l0", name,
                      axis_name(a), l0));
    }
  }

  CellBox nearest(const Box& b, const std::string& name) const {
    CellBox c;
    for (int a = 0; a < 3; ++a) {
      c.lower[a] = std::llround(in_cells(component(b.lower, a), a));
      c.upper[a] = std::llround(in_cells(component(b.upper, a), a));
    }
    require_cells(c, name, l0_);
    return c;
  }

  /// Faces that lie on the tank follow the tank; free faces go down or up to a lattice plane, whichever combination
  /// keeps volume and lengths best: the sum of the volume's and of the largest length's relative deviation is least.
  CellBox best_volume(const Box& b, const std::string& name) const {
    CellBox best;
    double least = std::numeric_limits<double>::infinity();
    for (int choice = 0; choice < 64; ++choice) {
      const CellBox c = faces(b, choice);
      double deviation = std::abs(c.cells() * l0_ * l0_ * l0_ / volume(b) - 1);
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
    require_cells(best, name, l0_);
    return best;
  }

  /// Bits of `choice`: whether each of the six faces goes up.
  CellBox faces(const Box& b, int choice) const {
    CellBox c;
    for (int a = 0; a < 3; ++a) {
      c.lower[a] = face(component(b.lower, a), a, (choice >> a) & 1);
      c.upper[a] = face(component(b.upper, a), a, (choice >> (a + 3)) & 1);
    }
    return c;
  }
  std::int64_t face(double x_m, int axis, bool up) const {
    if (std::abs(x_m - component(d_.tank.lower, axis)) < same_length_m) return tank_.lower[axis];
    if (std::abs(x_m - component(d_.tank.upper, axis)) < same_length_m) return tank_.upper[axis];
    const double cells = in_cells(x_m, axis);
    if (std::abs(cells - std::round(cells)) * l0_ < same_length_m) return std::llround(cells);
    return static_cast<std::int64_t>(up ? std::ceil(cells) : std::floor(cells));
  }

  const SceneDescription& d_;
  double l0_;
  CellBox tank_;
  std::vector<CellBox> fluid_;
  std::vector<CellBox> obstacles_;
};

/// Calls visit(cell) for every cell of a box, x fastest.
template <class Visit>
void for_each_cell(const CellBox& b, Visit&& visit) {
  Index3 c;
  for (c[2] = b.lower[2]; c[2] < b.upper[2]; ++c[2]) {
    for (c[1] = b.lower[1]; c[1] < b.upper[1]; ++c[1]) {
      for (c[0] = b.lower[0]; c[0] < b.upper[0]; ++c[0]) visit(c);
    }
  }
}

bool inside_any(const std::vector<CellBox>& boxes, const Index3& c) {
  for (const CellBox& b : boxes) {
    if (b.contains(c)) return true;
  }
  return false;
}

template <class Visit>
void for_each_fluid_cell(const Lattice& lattice, Visit&& visit) {
  const auto& fluid = lattice.fluid();
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    const std::vector<CellBox> earlier(fluid.begin(), fluid.begin() + static_cast<std::ptrdiff_t>(k));
    for_each_cell(fluid[k], [&](const Index3& c) {
      if (lattice.tank().contains(c) && !inside_any(lattice.obstacles(), c) && !inside_any(earlier, c)) visit(c);
    });
  }
}

/// How many layers deep a cell lies behind the tank's inner faces (0 the first); the tank is open at the top.
int tank_layer(const CellBox& tank, const Index3& c) {
  std::int64_t depth = 0;
  for (int a = 0; a < 3; ++a) {
    depth = std::max(depth, tank.lower[a] - c[a]);
    if (a < 2) depth = std::max(depth, c[a] - tank.upper[a] + 1);
  }
  return static_cast<int>(depth) - 1;
}

/// How many layers deep a cell lies inside an obstacle. A face that stands on the tank is not a wet face.
int obstacle_layer(const CellBox& obstacle, const CellBox& tank, const Index3& c) {
  std::int64_t depth = std::numeric_limits<std::int64_t>::max();
  for (int a = 0; a < 3; ++a) {
    if (obstacle.lower[a] > tank.lower[a]) depth = std::min(depth, c[a] - obstacle.lower[a]);
    if (obstacle.upper[a] < tank.upper[a]) depth = std::min(depth, obstacle.upper[a] - 1 - c[a]);
  }
  return depth > 1000 ? 1000 : static_cast<int>(depth);
}

/// Calls visit(cell, layer, body) for every wall particle: the tank first, then the obstacles.
template <class Visit>
void for_each_wall_cell(const Lattice& lattice, int layers, Visit&& visit) {
  const CellBox& tank = lattice.tank();
  CellBox shell = tank.grown(layers);
  shell.upper[2] = tank.upper[2];
  for (int body = 0; body <= static_cast<int>(lattice.obstacles().size()); ++body) {
    if (body == 0) {
      for_each_cell(shell, [&](const Index3& c) {
        if (!tank.contains(c)) visit(c, tank_layer(tank, c), body);
      });
      continue;
    }
    const CellBox& obstacle = lattice.obstacles()[static_cast<std::size_t>(body) - 1];
    for_each_cell(obstacle, [&](const Index3& c) {
      const int layer = obstacle_layer(obstacle, tank, c);
      if (layer < layers && tank.contains(c)) visit(c, layer, body);
    });
  }
}

/// A count that was summed in double precision, which holds every lattice that fits in any memory exactly; beyond what
/// an integer holds it stays at the largest.
std::int64_t as_count(double cells) {
  constexpr double largest = 4e18;
  return static_cast<std::int64_t>(std::min(cells, largest));
}

/// Counts without visiting cells, since a plan may be for more particles than one could visit: all boxes' faces cut
/// space into blocks that are fluid throughout or not at all.
std::int64_t count_fluid_cells(const Lattice& lattice) {
  std::array<std::vector<std::int64_t>, 3> cuts;
  const auto cut = [&](const CellBox& b) {
    for (int a = 0; a < 3; ++a) cuts[a].insert(cuts[a].end(), {b.lower[a], b.upper[a]});
  };
  cut(lattice.tank());
  std::for_each(lattice.fluid().begin(), lattice.fluid().end(), cut);
  std::for_each(lattice.obstacles().begin(), lattice.obstacles().end(), cut);
  for (auto& c : cuts) std::sort(c.begin(), c.end());
  double total = 0;
  for (std::size_t z = 0; z + 1 < cuts[2].size(); ++z) {
    for (std::size_t y = 0; y + 1 < cuts[1].size(); ++y) {
      for (std::size_t x = 0; x + 1 < cuts[0].size(); ++x) {
        const Index3 corner{cuts[0][x], cuts[1][y], cuts[2][z]};
        const CellBox block{corner, {cuts[0][x + 1], cuts[1][y + 1], cuts[2][z + 1]}};
        if (!lattice.tank().contains(corner) || inside_any(lattice.obstacles(), corner) ||
            !inside_any(lattice.fluid(), corner))
          continue;
        total += block.cells();
      }
    }
  }
  return as_count(total);
}

/// A body's wall particles are its box less the core that lies deeper than all layers.
std::int64_t count_wall_cells(const Lattice& lattice, int layers) {
  const CellBox& tank = lattice.tank();
  CellBox shell = tank.grown(layers);
  shell.upper[2] = tank.upper[2];
  double total = shell.cells() - tank.cells();
  for (const CellBox& obstacle : lattice.obstacles()) {
    CellBox core = obstacle;
    bool hollow = true;
    for (int a = 0; a < 3; ++a) {
      if (obstacle.lower[a] > tank.lower[a]) core.lower[a] += layers;
      if (obstacle.upper[a] < tank.upper[a]) core.upper[a] -= layers;
      hollow = hollow && core.upper[a] > core.lower[a];
    }
    total += obstacle.cells() - (hollow ? core.cells() : 0.0);
  }
  return as_count(total);
}

void record_fit(Scene& scene, const std::string& name, const Box& nominal, const Box& fitted) {
  for (int a = 0; a < 3; ++a) {
    for (const bool upper : {false, true}) {
      const double n = component(upper ? nominal.upper : nominal.lower, a);
      const double f = component(upper ? fitted.upper : fitted.lower, a);
      if (std::abs(n - f) <= same_length_m) continue;
      scene.fitted_lengths.push_back({fmt::format("{}.{}.{}", name, upper ? "upper" : "lower", axis_name(a)), n, f});
    }
  }
}

void fit(Scene& scene, const Lattice& lattice) {
  const SceneDescription& d = scene.description;
  scene.fitted = d;
  scene.fitted.tank = lattice.box(lattice.tank());
  record_fit(scene, "tank", d.tank, scene.fitted.tank);
  for (std::size_t k = 0; k < d.fluid.size(); ++k) {
    scene.fitted.fluid[k] = lattice.box(lattice.fluid()[k]);
    record_fit(scene, fmt::format("fluid[{}]", k), d.fluid[k], scene.fitted.fluid[k]);
    scene.nominal_fluid_volume_m3 += volume(d.fluid[k]);
  }
  for (std::size_t k = 0; k < d.obstacles.size(); ++k) {
    scene.fitted.obstacles[k] = lattice.box(lattice.obstacles()[k]);
    record_fit(scene, fmt::format("obstacle[{}]", k), d.obstacles[k], scene.fitted.obstacles[k]);
  }
}

}  // namespace

ParticleCounts count_particles(const SceneDescription& description) {
  const Lattice lattice(description);
  return {count_fluid_cells(lattice), count_wall_cells(lattice, description.wall_layers)};
}

Scene build_scene(const SceneDescription& description) {
  Scene scene;
  scene.description = description;
  const Lattice lattice(scene.description);
  fit(scene, lattice);
  for_each_fluid_cell(lattice, [&](const Index3& c) { scene.fluid.push_back(lattice.centre(c)); });
  for_each_wall_cell(lattice, description.wall_layers, [&](const Index3& c, int layer, int body) {
    scene.walls.push_back({lattice.centre(c), layer, body});
  });
  const double l0 = description.particle_distance_m;
  scene.fluid_volume_m3 = static_cast<double>(scene.fluid.size()) * l0 * l0 * l0;
  return scene;
}

}  // namespace sluice
