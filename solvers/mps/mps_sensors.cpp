// What sensors see of an MPS run, and snapshots of it. All sums here are scalar and in double precision.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/kernel_sums.h"
#include "solvers/mps/mps_solver.h"
#include "solvers/mps/terms.h"
#include "solvers/totals.h"

namespace sluice::mps {
namespace {

/// Calls visit(j, distance) for every particle of a set within the list's radius of a point, and for some beyond it.
template <class Pack, class Visit>
void for_each_near(const Particles<Pack>& p, const SearchSet& set, const Vec3d& point, double travel_m, Visit&& visit) {
  for (const Run& run : set.index.neighbours(point, travel_m)) {
    for (auto k = run.begin; k < run.end; ++k) {
      const std::size_t j = set.first + static_cast<std::size_t>(k);
      const Vec3d d = p.position.template at<double>(j) - point;
      visit(j, std::sqrt(dot(d, d)));
    }
  }
}

/// All particles have one volume, l0^3.
double filled_share(double weights, double l0) {
  return weights * l0 * l0 * l0;
}

}  // namespace

/// The sum that the WCSPH solver's sensors use, with the effective radius as kernel radius: sum P_b W_ab / sum W_ab
/// over fluid particles b   [Pa]   Eq. (33)
template <class Pack>
PressureReading MpsSolver<Pack>::kernel_pressure(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  KernelSums<double> sums(smoothing_length_m());
  for_each_near(particles_, {fluid_index_, particles_.first_fluid()}, point_m, travel_m_,
                [&](std::size_t j, double distance) {
                  if (distance < 2 * smoothing_length_m()) sums.add(distance, particles_.pressure[j]);
                });
  return {mean_pressure_Pa(sums), filled_share(sums.weights, constants_.parameters.particle_distance_m)};
}

/// The same mean of the velocity   [m/s]
template <class Pack>
VelocityReading MpsSolver<Pack>::kernel_velocity(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  KernelSums<Vec3d> sums(smoothing_length_m());
  for_each_near(particles_, {fluid_index_, particles_.first_fluid()}, point_m, travel_m_,
                [&](std::size_t j, double distance) {
                  if (distance < 2 * smoothing_length_m())
                    sums.add(distance, particles_.velocity.template at<double>(j));
                });
  return {mean_velocity_m_s(sums), filled_share(sums.weights, constants_.parameters.particle_distance_m)};
}

template <class Pack>
Vec3d MpsSolver<Pack>::wall_reaction_N(std::span<const std::int32_t> walls, const Box& fluid_within_m) const {
  Vec3d sum;
  for (const std::int32_t wall : walls) sum += reaction_of(place_of(wall), fluid_within_m);
  return sum;
}

/// Mass times the acceleration by a pressure gradient with P_i + P_j in the place of P_j - P_i, in which what two
/// particles do to each other is opposite and equal (Eq. 18 has no such symmetry); summed over the layers of a plane
/// wall under one pressure it is that pressure times the area, where a fluid particle has the volume that its number
/// density leaves it. A dummy has no pressure of its own: it takes its neighbour's.
template <class Pack>
Vec3d MpsSolver<Pack>::reaction_of(std::size_t i, const Box& fluid_within_m) const {
  const double l0 = constants_.parameters.particle_distance_m;
  const double radius = constants_.parameters.effective_radius_m();
  const double n0 = constants_.lattice.number_density;
  const Vec3d x = particles_.position.template at<double>(i);
  Vec3d sum;
  for_each_near(
      particles_, {fluid_index_, particles_.first_fluid()}, x, travel_m_, [&](std::size_t j, double distance) {
        const Vec3d x_j = particles_.position.template at<double>(j);
        if (distance >= radius || !holds_point(fluid_within_m, x_j)) return;
        const double P_i = particles_.is_dummy(i) ? particles_.pressure[j] : particles_.pressure[i];
        const double volume_share = n0 / std::max<double>(particles_.number_density[j], n0);
        sum += volume_share *
               gradient_term(-P_i, particles_.pressure[j], x_j - x, distance * distance, weight(distance, radius));
      });
  return (-l0 * l0 * l0 * 3 / n0) * sum;
}

template <class Pack>
double MpsSolver<Pack>::wall_particle_pressure_Pa(std::int32_t wall) const {
  return particles_.pressure[place_of(wall)];
}

template <class Pack>
double MpsSolver<Pack>::volume_fraction(const Vec3d& point_m) const {
  return kernel_pressure(point_m).support;
}

template <class Pack>
PressureReading MpsSolver<Pack>::wall_pressure(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for_each_near(particles_, {walls_.index, walls_.first}, point_m, 0.0, [&](std::size_t j, double distance) {
    if (distance >= least) return;
    least = distance;
    nearest = j;
  });
  if (!std::isfinite(least)) return {};
  return {particles_.pressure[nearest], 1};
}

template <class Pack>
FluidTotals MpsSolver<Pack>::totals() const {
  const Parameters& p = constants_.parameters;
  const double mass_kg = p.density_kg_m3 * std::pow(p.particle_distance_m, 3);
  const std::size_t first = particles_.first_fluid();
  FluidTotals totals =
      energies(particles_.position, particles_.velocity, first, particles_.fluid, mass_kg, p.gravity_m_s2);
  totals.greatest_density_ratio = greatest_number_density() / constants_.lattice.number_density;
  return totals;
}

template <class Pack>
std::string MpsSolver<Pack>::step_note() const {
  const auto& history = pressure_equation_.history();
  return fmt::format("{} unknowns, {} iterations, relative residuals {:.2e}", unknowns_,
                     std::max<std::size_t>(history.size(), 1) - 1, fmt::join(history, " "));
}

template <class Pack>
ParticleSnapshot MpsSolver<Pack>::snapshot() const {
  ParticleSnapshot s;
  s.time_s = time_s_;
  s.fluid_count = particles_.fluid;
  const auto copy = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      s.position_m.push_back(particles_.position.template at<float>(i));
      s.velocity_m_s.push_back(particles_.velocity.template at<float>(i));
      s.pressure_Pa.push_back(static_cast<float>(particles_.pressure[i]));
      s.density_kg_m3.push_back(static_cast<float>(constants_.parameters.density_kg_m3));
      s.id.push_back(particles_.id[i]);
    }
  };
  copy(particles_.first_fluid(), particles_.size());
  copy(particles_.first_wall(), particles_.first_fluid());
  copy(0, particles_.dummies);
  return s;
}

template class MpsSolver<FloatPack>;
template class MpsSolver<double>;

}  // namespace sluice::mps
