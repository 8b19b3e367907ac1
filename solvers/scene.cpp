#include "solvers/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solvers/scene_lattice.h"

namespace sluice {
namespace {

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
void for_each_fluid_cell(const SceneLattice& lattice, Visit&& visit) {
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

/// Which faces of an obstacle fluid can touch, by axis.
struct WetFaces {
  std::array<bool, 3> lower{};
  std::array<bool, 3> upper{};
};

/// Whether two boxes share a piece of the plane at which one ends and the other begins.
bool abut(const CellBox& a, const CellBox& b, int axis, bool at_upper) {
  if (at_upper ? a.upper[axis] != b.lower[axis] : a.lower[axis] != b.upper[axis]) return false;
  for (int other = 0; other < 3; ++other)
    if (other != axis && (a.lower[other] >= b.upper[other] || b.lower[other] >= a.upper[other])) return false;
  return true;
}

/// A face that stands on the tank stays dry unless the obstacle moves away from there. So do the sides of a body that
/// slides between others, such as a gate in its frame.
WetFaces wet_faces(const SceneLattice& lattice, const SceneDescription& d, std::size_t k) {
  const CellBox& o = lattice.obstacles()[k];
  const RigidMotion& motion = d.obstacles[k].motion;
  const auto slides_along_another = [&](int axis, bool at_upper) {
    if (!motion.moves() || component(motion.velocity_m_s, axis) != 0) return false;
    return std::any_of(lattice.obstacles().begin(), lattice.obstacles().end(),
                       [&](const CellBox& other) { return abut(o, other, axis, at_upper); });
  };
  WetFaces wet;
  for (int a = 0; a < 3; ++a) {
    const double v = motion.moves() ? component(motion.velocity_m_s, a) : 0.0;
    wet.lower[a] = v > 0 || (o.lower[a] > lattice.tank().lower[a] && !slides_along_another(a, false));
    wet.upper[a] = v < 0 || (o.upper[a] < lattice.tank().upper[a] && !slides_along_another(a, true));
  }
  return wet;
}

/// How many layers deep a cell lies inside an obstacle.
int obstacle_layer(const CellBox& obstacle, const WetFaces& wet, const Index3& c) {
  std::int64_t depth = std::numeric_limits<std::int64_t>::max();
  for (int a = 0; a < 3; ++a) {
    if (wet.lower[a]) depth = std::min(depth, c[a] - obstacle.lower[a]);
    if (wet.upper[a]) depth = std::min(depth, obstacle.upper[a] - 1 - c[a]);
  }
  return depth > 1000 ? 1000 : static_cast<int>(depth);
}

/// Calls visit(cell, layer, body) for every wall particle: the tank first, then the obstacles.
template <class Visit>
void for_each_wall_cell(const SceneLattice& lattice, const SceneDescription& d, Visit&& visit) {
  const CellBox& tank = lattice.tank();
  CellBox shell = tank.grown(d.wall_layers);
  shell.upper[2] = tank.upper[2];
  for_each_cell(shell, [&](const Index3& c) {
    if (!tank.contains(c)) visit(c, tank_layer(tank, c), 0);
  });
  for (std::size_t k = 0; k < lattice.obstacles().size(); ++k) {
    const CellBox& obstacle = lattice.obstacles()[k];
    const WetFaces wet = wet_faces(lattice, d, k);
    for_each_cell(obstacle, [&](const Index3& c) {
      const int layer = obstacle_layer(obstacle, wet, c);
      if (layer < d.wall_layers && tank.contains(c)) visit(c, layer, static_cast<int>(k) + 1);
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
std::int64_t count_fluid_cells(const SceneLattice& lattice) {
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
std::int64_t count_wall_cells(const SceneLattice& lattice, const SceneDescription& d) {
  const CellBox& tank = lattice.tank();
  CellBox shell = tank.grown(d.wall_layers);
  shell.upper[2] = tank.upper[2];
  double total = shell.cells() - tank.cells();
  for (std::size_t k = 0; k < lattice.obstacles().size(); ++k) {
    const CellBox obstacle = lattice.obstacles()[k].shared_with(tank);
    const WetFaces wet = wet_faces(lattice, d, k);
    CellBox core = obstacle;
    bool hollow = true;
    for (int a = 0; a < 3; ++a) {
      if (wet.lower[a]) core.lower[a] += d.wall_layers;
      if (wet.upper[a]) core.upper[a] -= d.wall_layers;
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

/// A body that rises without a given end stops where no fluid can reach it any more.
void end_motion(Obstacle& o, const SceneDescription& d, std::size_t k) {
  if (!o.motion.moves() || std::isfinite(o.motion.stop_s)) return;
  const Vec3d& v = o.motion.velocity_m_s;
  if (v.x != 0 || v.y != 0 || v.z < 0)
    throw std::invalid_argument(
        fmt::format("obstacle[{}] moves for ever and not upwards: give the time at which it stops", k));
  constexpr double reach_over_distance = 8;
  const double clear_m = fluid_ceiling_m(d.tank) + reach_over_distance * d.particle_distance_m;
  o.motion.stop_s = o.motion.start_s + std::max(0.0, clear_m - o.box.lower.z) / v.z;
}

void fit(Scene& scene, const SceneLattice& lattice) {
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
    Obstacle& fitted = scene.fitted.obstacles[k];
    fitted.box = lattice.box(lattice.obstacles()[k]);
    record_fit(scene, called(d.obstacles[k], k), d.obstacles[k].box, fitted.box);
    end_motion(fitted, scene.fitted, k);
  }
}

}  // namespace

std::string called(const Obstacle& obstacle, std::size_t k) {
  return obstacle.name.empty() ? fmt::format("obstacle[{}]", k) : obstacle.name;
}

double fluid_ceiling_m(const Box& tank) {
  return tank.upper.z + 0.5 * (tank.upper.z - tank.lower.z);
}

double Scene::still_level_m(const Vec3d& p, double reach_m) const {
  double level = fitted.tank.lower.z;
  for (std::size_t k = 0; k < fitted.fluid.size(); ++k) {
    const Box& b = fitted.fluid[k];
    const bool over = p.x > b.lower.x - reach_m && p.x < b.upper.x + reach_m && p.y > b.lower.y - reach_m &&
                      p.y < b.upper.y + reach_m;
    if (over) level = std::max(level, description.fluid[k].upper.z);
  }
  return level;
}

ParticleCounts count_particles(const SceneDescription& description) {
  const SceneLattice lattice(description);
  return {count_fluid_cells(lattice), count_wall_cells(lattice, description)};
}

Scene build_scene(const SceneDescription& description) {
  Scene scene;
  scene.description = description;
  const SceneLattice lattice(scene.description);
  fit(scene, lattice);
  for_each_fluid_cell(lattice, [&](const Index3& c) { scene.fluid.push_back(lattice.centre(c)); });
  for_each_wall_cell(lattice, description, [&](const Index3& c, int layer, int body) {
    scene.walls.push_back({lattice.centre(c), layer, body});
  });
  const double l0 = description.particle_distance_m;
  scene.fluid_volume_m3 = static_cast<double>(scene.fluid.size()) * l0 * l0 * l0;
  return scene;
}

}  // namespace sluice
