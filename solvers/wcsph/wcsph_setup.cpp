// Setting a WCSPH solver up: parameters checked, particles placed, fluid at rest under its own weight.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "solvers/require.h"
#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice::wcsph {
namespace {

/// How far particles may travel between two sorts, and the length of a search slice, in particle distances: measured to
/// be the cheapest choices in violent flow (see bench/).
constexpr double slack_over_distance = 0.08;
constexpr double slice_over_distance = 0.5;

Parameters checked(const Parameters& p) {
  require(p.particle_distance_m > 0, "particle_distance_m", p.particle_distance_m, "positive");
  require(p.speed_of_sound_m_s > 0, "speed_of_sound_m_s", p.speed_of_sound_m_s, "positive");
  require(p.reference_density_kg_m3 > 0, "reference_density_kg_m3", p.reference_density_kg_m3, "positive");
  require(p.courant > 0 && p.courant <= 1, "courant", p.courant, "in (0, 1]");
  require(p.alpha >= 0, "alpha", p.alpha, "zero or more");
  require(p.delta >= 0 && p.delta <= 1, "delta", p.delta, "in [0, 1]");
  require(p.gamma == 7, "gamma", p.gamma, "7, the only exponent this solver has");
  require(p.kernel_radius_over_distance >= 2 && p.kernel_radius_over_distance <= 4, "kernel_radius_over_distance",
          p.kernel_radius_over_distance, "in [2, 4] (fluid on the two sides of a plate is 4 l0 apart)");
  require(p.wall_friction >= 0 && p.wall_friction <= 1, "wall_friction", p.wall_friction, "in [0, 1]");
  require(p.tension_limit >= 0 && p.tension_limit <= 1, "tension_limit", p.tension_limit, "in [0, 1]");
  require(p.restart_interval >= 1, "restart_interval", p.restart_interval, "one or more");
  return p;
}

/// Fluid half a particle distance in front of a wall reaches through the layers that extrapolate its pressure.
void require_thick_walls(const Scene& scene, const Parameters& p) {
  const int needed = static_cast<int>(std::ceil(p.kernel_radius_over_distance - 0.5));
  if (p.walls != WallModel::extrapolated || scene.description.wall_layers >= needed) return;
  throw std::invalid_argument(fmt::format(
      "wall_layers = {}: extrapolated walls need {} layers with kernel_radius_over_distance = {:g}, so that "
      "the kernel of fluid at a wall ends within it",
      scene.description.wall_layers, needed, p.kernel_radius_over_distance));
}

RowGeometry rows(const Tank& tank, const Parameters& p) {
  const double l0 = p.particle_distance_m;
  return {tank.domain(), 2 * p.smoothing_length_m(), slack_over_distance * l0, slice_over_distance * l0};
}

}  // namespace

template <class Pack>
WcsphSolver<Pack>::WcsphSolver(const Scene& scene, const Parameters& parameters, int threads)
    : parameters_(checked(parameters)),
      threads_(std::max(1, threads)),
      tank_(scene),
      constants_(parameters_, FixedPoint<typename Lanes<Pack>::Coordinate>::quantum_m(longest_edge(tank_.domain()))),
      fluid_index_(rows(tank_, parameters_)),
      wall_index_(rows(tank_, parameters_)),
      wall_proximity_(wall_index_),
      moving_walls_(scene) {
  require_thick_walls(scene, parameters_);
  place_walls(scene);
  place_fluid(scene);
  if (parameters_.walls == WallModel::dynamic) {
    const double reach_m = fluid_index_.geometry().radius_m;
    for (const std::int32_t w : wet_walls_) {
      const auto i = static_cast<std::size_t>(w);
      fill_hydrostatically(walls_, i, hydrostatic_level_m(scene, walls_.position.template at<double>(i), reach_m));
    }
  }
  update_fluid_state();
  update_walls();
}

template <class Pack>
void WcsphSolver<Pack>::place_fluid(const Scene& scene) {
  fluid_.resize(scene.fluid.size());
  for (std::size_t i = 0; i < fluid_.n; ++i) {
    fluid_.position.set(i, scene.fluid[i]);
    fluid_.id[i] = static_cast<std::int32_t>(i);
  }
  for (std::size_t i = 0; i < fluid_.n; ++i)
    fill_hydrostatically(fluid_, i, hydrostatic_level_m(scene, fluid_.position.template at<double>(i), 0));
  sort_if_due(true);
}

template <class Pack>
void WcsphSolver<Pack>::place_walls(const Scene& scene) {
  walls_.resize(scene.walls.size());
  first_wall_id_ = static_cast<std::int32_t>(scene.fluid.size());
  for (std::size_t i = 0; i < walls_.n; ++i) {
    walls_.position.set(i, scene.walls[i].position);
    walls_.id[i] = first_wall_id_ + static_cast<std::int32_t>(i);
    wall_layer_.push_back(static_cast<std::int8_t>(scene.walls[i].layer));
  }
  wall_place_.resize(walls_.n);
  std::iota(wall_place_.begin(), wall_place_.end(), 0);
  set_moving_walls(0);
  sort_walls();
}

/// From the order of Scene::walls, so that the sorted order at a time does not depend on the sorts before.
template <class Pack>
void WcsphSolver<Pack>::sort_walls() {
  VectorField<double> position;
  gather(walls_.position, wall_place_, position);
  wall_index_.sort(position.x, position.y, position.z, {}, threads_);
  const std::span<const std::int32_t> order = wall_index_.order();
  std::vector<std::int32_t> from(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) from[k] = wall_place_[static_cast<std::size_t>(order[k])];
  walls_.permute(from, threads_);
  for (std::size_t k = 0; k < order.size(); ++k)
    wall_place_[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  wall_proximity_ = Proximity(wall_index_);
  walls_.encode_positions(tank_.domain(), 0, walls_.n);
  wall_travel_m_ = 0;
  walls_sorted_at_s_ = walls_at_s_;
}

/// Bodies with a prescribed motion go to where they are at a time.
template <class Pack>
void WcsphSolver<Pack>::set_moving_walls(double t_s) {
  walls_at_s_ = t_s;
  tank_.move_obstacles(t_s);
  moving_walls_.for_each(t_s, [&](std::int32_t wall, const Vec3d& position, const Vec3d& velocity) {
    const auto i = static_cast<std::size_t>(wall_place_[static_cast<std::size_t>(wall)]);
    walls_.position.set(i, position);
    walls_.velocity.set(i, velocity);
    walls_.encode_positions(tank_.domain(), i, i + 1);
  });
}

/// The still level at a point, or H_W above the tank's floor where that is lower   [m]
template <class Pack>
double WcsphSolver<Pack>::hydrostatic_level_m(const Scene& scene, const Vec3d& point_m, double reach_m) const {
  return std::min(scene.fitted.tank.lower.z + parameters_.water_height_m, scene.still_level_m(point_m, reach_m));
}

/// P = rho_0 g (H - z) below the level H   [Pa]
template <class Pack>
void WcsphSolver<Pack>::fill_hydrostatically(Particles<Pack>& particles, std::size_t i, double level_m) const {
  const double depth = level_m - particles.position.z[i];
  const double pressure = std::max(0.0, -parameters_.reference_density_kg_m3 * parameters_.gravity_m_s2.z * depth);
  particles.density[i] = static_cast<typename Lanes<Pack>::Real>(tait_density_deviation(pressure, constants_.tait));
  particles.density_previous[i] = particles.density[i];
}

template <class Pack>
std::int64_t WcsphSolver<Pack>::memory_bytes() const {
  return fluid_.memory_bytes() + walls_.memory_bytes() + fluid_index_.memory_bytes() + wall_index_.memory_bytes() +
         wall_proximity_.memory_bytes() +
         static_cast<std::int64_t>(leaves_.capacity() + wet_.capacity() + wall_layer_.capacity()) + bytes(wet_walls_) +
         bytes(wall_place_);
}

template <class Pack>
std::map<std::string, double> WcsphSolver<Pack>::facts() const {
  return {{"c0_m_s", parameters_.speed_of_sound_m_s},
          {"h_m", parameters_.smoothing_length_m()},
          {"sorts", static_cast<double>(sorts_)},
          {"held_at_walls", static_cast<double>(held_)},
          {"lanes", static_cast<double>(Lanes<Pack>::width)}};
}

template <class Pack>
void WcsphSolver<Pack>::set_fluid(std::int32_t id, const Vec3d& velocity_m_s, double density_deviation_kg_m3) {
  const auto found = std::find(fluid_.id.begin(), fluid_.id.end(), id);
  if (found == fluid_.id.end()) throw std::invalid_argument(fmt::format("no fluid particle has the id {}", id));
  const auto i = static_cast<std::size_t>(found - fluid_.id.begin());
  fluid_.velocity.set(i, velocity_m_s);
  fluid_.velocity_previous.set(i, velocity_m_s);
  fluid_.density[i] = static_cast<typename Lanes<Pack>::Real>(density_deviation_kg_m3);
  fluid_.density_previous[i] = fluid_.density[i];
  update_fluid_state();
  update_walls();
}

template class WcsphSolver<FloatPack>;
template class WcsphSolver<double>;

}  // namespace sluice::wcsph

namespace sluice {

std::unique_ptr<Solver> make_wcsph_solver(const Scene& scene, const wcsph::Parameters& parameters, int threads) {
  return std::make_unique<wcsph::WcsphSolver<FloatPack>>(scene, parameters, threads);
}

}  // namespace sluice
