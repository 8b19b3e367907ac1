// What a WCSPH run must remember between two steps.
#include <fmt/format.h>

#include <stdexcept>

#include "solvers/state_archive.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice::wcsph {

template <class Pack>
void WcsphSolver<Pack>::visit_state(StateArchive& archive) {
  archive.value("time_s", time_s_);
  archive.value("steps", steps_);
  auto n = static_cast<std::int64_t>(fluid_.n);
  archive.value("fluid_particles", n);
  if (n < 0 || static_cast<std::size_t>(n) > fluid_.n)
    throw std::runtime_error(fmt::format("{} fluid particles where the scene has {}", n, fluid_.n));
  fluid_.resize(static_cast<std::size_t>(n));
  archive.values("position_m", fluid_.position, 0, fluid_.n);
  archive.values("velocity_m_s", fluid_.velocity, 0, fluid_.n);
  archive.values("velocity_previous_m_s", fluid_.velocity_previous, 0, fluid_.n);
  archive.values("density_deviation_kg_m3", std::span(fluid_.density).first(fluid_.n));
  archive.values("density_deviation_previous_kg_m3", std::span(fluid_.density_previous).first(fluid_.n));
  archive.values("id", std::span(fluid_.id).first(fluid_.n));
  visit_moving_walls(archive);
  archive.values("wall_density_deviation_kg_m3", std::span(walls_.density).first(walls_.n));
  archive.values("wall_density_deviation_previous_kg_m3", std::span(walls_.density_previous).first(walls_.n));
  archive.value("travel_m", travel_m_);
  fluid_index_.visit_state(archive, "sort", fluid_.n);
  archive.value("sorts", sorts_);
  archive.value("held_at_walls", held_);
  archive.value("lost_over_top", lost_.over_top);
  archive.value("lost_through_walls", lost_.through_walls);
  if (archive.restoring()) {
    find_wet_walls();  // as at the last sort, when moving walls stood where they are now
    if (moving_walls_.any()) set_moving_walls(time_s_);
    update_fluid_state();
    update_walls();
  }
}

/// Walls that move come back into the order and to the place that they had at the last sort.
template <class Pack>
void WcsphSolver<Pack>::visit_moving_walls(StateArchive& archive) {
  if (!moving_walls_.any()) return;
  archive.value("walls_sorted_at_s", walls_sorted_at_s_);
  archive.value("wall_travel_m", wall_travel_m_);
  if (!archive.restoring()) return;
  const double travel_m = wall_travel_m_;
  set_moving_walls(walls_sorted_at_s_);
  sort_walls();
  wall_travel_m_ = travel_m;
}

template class WcsphSolver<FloatPack>;
template class WcsphSolver<double>;

}  // namespace sluice::wcsph
