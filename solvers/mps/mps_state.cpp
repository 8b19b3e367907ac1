// What an MPS run must remember between two steps.
#include <fmt/format.h>

#include <stdexcept>

#include "solvers/mps/mps_solver.h"
#include "solvers/state_archive.h"

namespace sluice::mps {

template <class Pack>
void MpsSolver<Pack>::visit_state(StateArchive& archive) {
  archive.value("time_s", time_s_);
  archive.value("steps", steps_);
  auto n = static_cast<std::int64_t>(particles_.fluid);
  archive.value("fluid_particles", n);
  if (n < 0 || static_cast<std::size_t>(n) > particles_.fluid)
    throw std::runtime_error(fmt::format("{} fluid particles where the scene has {}", n, particles_.fluid));
  particles_.resize(particles_.dummies, particles_.walls, static_cast<std::size_t>(n));
  listed_.resize(particles_.fluid);
  if (archive.restoring() && moving_walls_.any()) bring_walls_to(time_s_);
  const std::size_t first = particles_.first_fluid();
  archive.values("position_m", particles_.position, first, particles_.fluid);
  archive.values("listed_position_m", listed_, 0, particles_.fluid);
  archive.values("velocity_m_s", particles_.velocity, first, particles_.fluid);
  archive.values("pressure_Pa", std::span(particles_.pressure));
  archive.values("id", std::span(particles_.id).subspan(first));
  archive.value("travel_m", travel_m_);
  visit_counts(archive);
  if (archive.restoring()) list_as_before();
}

template <class Pack>
void MpsSolver<Pack>::visit_counts(StateArchive& archive) {
  archive.value("lost_over_top", lost_.over_top);
  archive.value("lost_through_walls", lost_.through_walls);
  archive.value("iterations", iterations_);
  archive.value("most_iterations", most_iterations_);
  archive.value("unknowns", unknowns_);
  archive.value("collisions", collisions_);
  archive.value("plain_gradients", plain_gradients_);
  archive.value("negative_pressures", negative_pressures_);
  archive.value("fluid_steps", fluid_steps_);
  archive.value("greatest_density_ratio", greatest_density_ratio_);
}

/// Lists neighbours where they were when they were last listed: the pressure correction has moved particles since.
template <class Pack>
void MpsSolver<Pack>::list_as_before() {
  const VectorField<double> now = particles_.position;
  for (std::size_t k = 0; k < particles_.fluid; ++k)
    particles_.position.set(particles_.first_fluid() + k, listed_.template at<double>(k));
  leaves_.assign(particles_.fluid, 0);
  list_rows();
  particles_.position = now;
  particles_.encode_positions(tank_.domain(), particles_.first_fluid(), threads_);
}

template class MpsSolver<FloatPack>;
template class MpsSolver<double>;

}  // namespace sluice::mps
