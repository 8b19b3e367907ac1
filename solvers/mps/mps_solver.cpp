#include "solvers/mps/mps_solver.h"

#include <algorithm>

#include "solvers/leaving.h"

namespace sluice::mps {

/// One step of the paper's section 2.3.
template <class Pack>
double MpsSolver<Pack>::step() {
  clock_.time("prediction", [&] { predict(); });
  clock_.time("collisions", [&] { collide_pairs(); });
  clock_.time("motion", [&] { move(); });
  clock_.time("neighbours", [&] { list_neighbours(); });
  clock_.time("pressure", [&] { solve_pressures(); });
  clock_.time("correction", [&] { correct_velocities(); });
  time_s_ += constants_.dt_s;
  ++steps_;
  return constants_.dt_s;
}

/// u* of viscosity and gravity, Eq. (21).
template <class Pack>
void MpsSolver<Pack>::predict() {
  predict_velocities(particles_, list_, constants_, next_velocity_, threads_);
  particles_.velocity.swap(next_velocity_);
}

/// r* = r + dt u*   Eq. (22)
template <class Pack>
void MpsSolver<Pack>::move() {
  const auto n = static_cast<std::int64_t>(particles_.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (auto k = static_cast<std::int64_t>(particles_.first_fluid()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    particles_.position.set(
        i, particles_.position.template at<double>(i) + constants_.dt_s * particles_.velocity.template at<double>(i));
  }
  const double end_s = time_s_ + constants_.dt_s;
  if (moving_walls_.change(time_s_, end_s)) bring_walls_to(end_s);
}

template <class Pack>
void MpsSolver<Pack>::list_neighbours() {
  const std::size_t first = particles_.first_fluid();
  leaves_.resize(particles_.fluid);
  const LostParticles left = find_leaving(tank_, particles_.position, first, leaves_, *this, threads_);
  lost_.over_top += left.over_top;
  lost_.through_walls += left.through_walls;
  list_rows();
  travel_m_ = 0;
}

/// Sorts the fluid that has not left, and lists the neighbours.
template <class Pack>
void MpsSolver<Pack>::list_rows() {
  const std::size_t first = particles_.first_fluid();
  const auto fluid = [&](const std::vector<double>& v) { return std::span<const double>(v).subspan(first); };
  const auto& x = particles_.position;
  fluid_index_.sort(fluid(x.x), fluid(x.y), fluid(x.z), leaves_, threads_);
  particles_.permute_fluid(fluid_index_.order(), threads_);
  next_velocity_.resize(particles_.size());
  particles_.encode_positions(tank_.domain(), first, threads_);
  list_.list(particles_, fluid_set(), wall_set(), dummy_set(), reach_, threads_);
  listed_.resize(particles_.fluid);
  const auto n = static_cast<std::int64_t>(particles_.fluid);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t k = 0; k < n; ++k)
    listed_.set(static_cast<std::size_t>(k), x.template at<double>(first + static_cast<std::size_t>(k)));
}

template <class Pack>
void MpsSolver<Pack>::collide_pairs() {
  const Parameters& p = constants_.parameters;
  if (p.collision_over_distance <= 0 && p.wall_contact_over_distance <= 0) return;
  collisions_ += collide(particles_, wall_normals_, list_, constants_, next_velocity_, threads_);
  particles_.velocity.swap(next_velocity_);
}

template <class Pack>
void MpsSolver<Pack>::solve_pressures() {
  const PressureReport report = pressure_equation_.solve(particles_, list_);
  iterations_ += report.convergence.iterations;
  most_iterations_ = std::max<std::int64_t>(most_iterations_, report.convergence.iterations);
  unknowns_ = report.unknowns;
  negative_pressures_ += report.set_to_zero;
}

template <class Pack>
void MpsSolver<Pack>::correct_velocities() {
  const CorrectionReport report = correct(particles_, list_, constants_, threads_);
  plain_gradients_ += report.plain_gradients;
  fluid_steps_ += static_cast<std::int64_t>(particles_.fluid);
  greatest_density_ratio_ =
      std::max(greatest_density_ratio_, greatest_number_density() / constants_.lattice.number_density);
  travel_m_ = report.greatest_move_m;
  if (travel_m_ > fluid_index_.geometry().slack_m) {
    list_neighbours();
  } else {
    particles_.encode_positions(tank_.domain(), particles_.first_fluid(), threads_);
  }
}

template <class Pack>
double MpsSolver<Pack>::greatest_number_density() const {
  const auto first = particles_.number_density.begin() + static_cast<std::ptrdiff_t>(particles_.first_fluid());
  const auto last = first + static_cast<std::ptrdiff_t>(particles_.fluid);
  return first == last ? 0.0 : static_cast<double>(*std::max_element(first, last));
}

template class MpsSolver<FloatPack>;
template class MpsSolver<double>;

}  // namespace sluice::mps
