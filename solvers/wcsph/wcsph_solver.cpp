#include "solvers/wcsph/wcsph_solver.h"

#include <algorithm>
#include <cmath>

#include "solvers/leaving.h"
#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/time_step.h"
#include "solvers/wcsph/verlet.h"

namespace sluice::wcsph {
namespace {

/// Pressure, cut off where the fluid would tear, volume and speed of sound of one particle from its density.
template <class Pack>
void apply_equation_of_state(Particles<Pack>& p, std::size_t i, const PairConstants<Pack>& c) {
  p.pressure[i] = std::max(tait_pressure(p.density[i], c.tait), c.least_pressure);
  p.volume[i] = c.mass / (c.reference_density + p.density[i]);
  p.sound[i] = tait_speed_of_sound(p.density[i], c.tait);
}

/// The velocity from which the next leap starts, of a particle that was held: `now` where the wall has taken something
/// (`was`), else `now` less what the step has added, as after a restart. So the leap neither brings back what the wall
/// took, nor counts twice what moves the particle along the wall.
Vec3d before_held(const Vec3d& was, const Vec3d& now, const Vec3d& added) {
  return {now.x == was.x ? now.x - added.x : now.x, now.y == was.y ? now.y - added.y : now.y,
          now.z == was.z ? now.z - added.z : now.z};
}

}  // namespace

/// One step of the paper's section 2.2. Derived state (order, pressures, walls) belongs to the time at which the step
/// ends, so that sensors between two steps see one instant.
template <class Pack>
double WcsphSolver<Pack>::step() {
  const StepLimits limits = sum_rates();
  const double dt = time_step(parameters_, limits);
  require_progress(parameters_, dt, time_s_);
  clock_.time("advance", [&] { advance(dt); });
  clock_.time("sort", [&] { sort_if_due(); });
  clock_.time("equation_of_state", [&] { update_fluid_state(); });
  clock_.time("walls", [&] { update_walls(); });
  time_s_ += dt;
  ++steps_;
  return dt;
}

template <class Pack>
StepLimits WcsphSolver<Pack>::sum_rates() {
  if (parameters_.walls == WallModel::dynamic) {
    clock_.time("walls", [&] { sum_wall_density_rates(walls_, wet_walls_, sorted_fluid(), constants_, threads_); });
  }
  return clock_.time("pair_sums",
                     [&] { return sum_fluid_rates(fluid_, sorted_fluid(), sorted_walls(), constants_, threads_); });
}

template <class Pack>
void WcsphSolver<Pack>::advance(double dt_s) {
  const auto form = steps_ % parameters_.restart_interval == 0 ? VerletForm::restart : VerletForm::leap;
  const double moved_m = advance_fluid(fluid_, dt_s, form, constants_.least_density, threads_);
  travel_m_ += moved_m;
  move_walls(dt_s);
  if (parameters_.walls == WallModel::dynamic) advance_wall_density(walls_, dt_s, form, threads_);
  if (parameters_.walls == WallModel::extrapolated) {
    // Who is set back on the way that it came has moved less; who falls from the rim behind a wall, more.
    if (const double set_back_m = hold_at_walls(dt_s); set_back_m > moved_m) travel_m_ += set_back_m;
  }
}

/// What a wall travels counts with what the fluid does: the search allows for how far the two move against each other.
template <class Pack>
void WcsphSolver<Pack>::move_walls(double dt_s) {
  if (!moving_walls_.change(time_s_, time_s_ + dt_s)) return;
  set_moving_walls(time_s_ + dt_s);
  const double moved_m = moving_walls_.travel_m(time_s_, time_s_ + dt_s);
  travel_m_ += moved_m;
  wall_travel_m_ += moved_m;
}

/// Extrapolated pressures alone let particles slip between wall particles: in a thin film some of a thousand at every
/// step. Dynamic walls are left to leak, as the paper's do. Returns how far the farthest was set back [m].
template <class Pack>
double WcsphSolver<Pack>::hold_at_walls(double dt_s) {
  const auto n = static_cast<std::int64_t>(fluid_.n);
  std::int64_t held = 0;
  double farthest2 = 0;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(+ : held) reduction(max : farthest2)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3d at = fluid_.position.template at<double>(i);
    const Vec3d u = fluid_.velocity.template at<double>(i);
    Vec3d held_at = at;
    Vec3d held_u = u;
    if (!tank_.hold(held_at, held_u)) continue;
    fluid_.position.set(i, held_at);
    fluid_.velocity.set(i, held_u);
    fluid_.velocity_previous.set(i, before_held(u, held_u, dt_s * fluid_.acceleration.template at<double>(i)));
    farthest2 = std::max(farthest2, dot(held_at - at, held_at - at));
    ++held;
  }
  held_ += held;
  return std::sqrt(farthest2);
}

/// Sorts when particles have travelled as far as the search allows, or when one has left.
template <class Pack>
void WcsphSolver<Pack>::sort_if_due(bool at_once) {
  leaves_.resize(fluid_.n);
  const LostParticles left = find_leaving(tank_, fluid_.position, 0, leaves_, *this, threads_);
  if (!at_once && travel_m_ <= fluid_index_.geometry().slack_m && left.over_top + left.through_walls == 0) return;
  lost_.over_top += left.over_top;
  lost_.through_walls += left.through_walls;
  fluid_index_.sort(fluid_.position.x, fluid_.position.y, fluid_.position.z, leaves_, threads_);
  fluid_.permute(fluid_index_.order(), threads_);
  travel_m_ = 0;
  ++sorts_;
  if (wall_travel_m_ > 0) sort_walls();
  find_wet_walls();
}

template <class Pack>
void WcsphSolver<Pack>::update_fluid_state() {
  const auto n = static_cast<std::int64_t>(fluid_.n);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t block = 0; block < (n + 1023) / 1024; ++block) {
    const std::int64_t last = std::min(n, (block + 1) * 1024);
    fluid_.encode_positions(tank_.domain(), static_cast<std::size_t>(block) * 1024, static_cast<std::size_t>(last));
    for (std::int64_t i = block * 1024; i < last; ++i)
      apply_equation_of_state(fluid_, static_cast<std::size_t>(i), constants_);
  }
}

template <class Pack>
void WcsphSolver<Pack>::update_walls() {
  if (parameters_.walls == WallModel::extrapolated) {
    extrapolate_wall_pressures(walls_, wet_walls_, sorted_fluid(), constants_, threads_);
  }
  const auto n = static_cast<std::int64_t>(wet_walls_.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    apply_equation_of_state(walls_, static_cast<std::size_t>(wet_walls_[static_cast<std::size_t>(k)]), constants_);
  }
}

/// Wall particles that no fluid can reach until the next sort are left out of the sums. Extrapolated ones carry no
/// pressure then; dynamic ones keep the density that they have.
template <class Pack>
void WcsphSolver<Pack>::find_wet_walls() {
  const auto n = static_cast<std::int64_t>(walls_.n);
  wet_.resize(walls_.n);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    wet_[i] = fluid_index_.any_near(walls_.position.template at<double>(i));
    if (wet_[i] != 0) continue;
    walls_.density_rate[i] = 0;
    if (parameters_.walls == WallModel::extrapolated) walls_.density[i] = 0;
    walls_.density_previous[i] = walls_.density[i];  // or the leap would swap two old values
    apply_equation_of_state(walls_, i, constants_);
  }
  wet_walls_.clear();
  for (std::size_t i = 0; i < walls_.n; ++i) {
    if (wet_[i] != 0) wet_walls_.push_back(static_cast<std::int32_t>(i));
  }
}

template class WcsphSolver<FloatPack>;
template class WcsphSolver<double>;

}  // namespace sluice::wcsph
