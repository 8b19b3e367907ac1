// What sensors see of a WCSPH run, and snapshots of it. All sums here are scalar and in double precision.
#include <algorithm>
#include <cmath>

#include "solvers/kernel_sums.h"
#include "solvers/totals.h"
#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/terms.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice::wcsph {
namespace {

/// Calls visit(j, distance) for every particle within the kernel's radius of a point.
template <class Pack, class Visit>
void for_each_near(const Sorted<Pack>& sorted, const Vec3d& point, Visit&& visit) {
  const double radius2 = sorted.index.geometry().radius_m * sorted.index.geometry().radius_m;
  for (const Run& run : sorted.index.neighbours(point, sorted.travel_m)) {
    for (auto j = static_cast<std::size_t>(run.begin); j < static_cast<std::size_t>(run.end); ++j) {
      const Vec3d d = sorted.particles.position.template at<double>(j) - point;
      const double distance2 = dot(d, d);
      if (distance2 < radius2) visit(j, std::sqrt(distance2));
    }
  }
}

}  // namespace

/// P_a = sum_b P_b W_ab / sum_b W_ab over fluid particles b   [Pa]   Eq. (33)
template <class Pack>
PressureReading WcsphSolver<Pack>::kernel_pressure(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  KernelSums<double> sums(parameters_.smoothing_length_m());
  double filled = 0;
  for_each_near(sorted_fluid(), point_m, [&](std::size_t j, double distance) {
    filled += sums.add(distance, static_cast<double>(fluid_.pressure[j])) * static_cast<double>(fluid_.volume[j]);
  });
  return {mean_pressure_Pa(sums), filled};
}

template <class Pack>
double WcsphSolver<Pack>::volume_fraction(const Vec3d& point_m) const {
  return kernel_pressure(point_m).support;
}

/// The same mean of the velocity   [m/s]
template <class Pack>
VelocityReading WcsphSolver<Pack>::kernel_velocity(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  KernelSums<Vec3d> sums(parameters_.smoothing_length_m());
  double filled = 0;
  for_each_near(sorted_fluid(), point_m, [&](std::size_t j, double distance) {
    filled += sums.add(distance, fluid_.velocity.template at<double>(j)) * static_cast<double>(fluid_.volume[j]);
  });
  return {mean_velocity_m_s(sums), filled};
}

/// Sum of m times Eq. (3) over wall particles, with fluid neighbours only and without gravity: by the terms' symmetry
/// the opposite of what these particles do to the fluid.
template <class Pack>
Vec3d WcsphSolver<Pack>::wall_reaction_N(std::span<const std::int32_t> walls, const Box& fluid_within_m) const {
  Vec3d sum;
  for (const std::int32_t w : walls)
    sum += reaction_of(static_cast<std::size_t>(wall_place_[static_cast<std::size_t>(w)]), fluid_within_m);
  return sum;
}

template <class Pack>
Vec3d WcsphSolver<Pack>::reaction_of(std::size_t i, const Box& fluid_within_m) const {
  const double h = parameters_.smoothing_length_m();
  const double rho_0 = parameters_.reference_density_kg_m3;
  const double mass = rho_0 * std::pow(parameters_.particle_distance_m, 3);
  const double viscosity_factor = mass * parameters_.alpha * h * parameters_.wall_friction;
  const auto least_sum = static_cast<double>(lane_max(constants_.with_wall.least_pressure_sum));
  const Vec3d x = walls_.position.template at<double>(i);
  const Vec3d u = walls_.velocity.template at<double>(i);
  const double density = rho_0 + static_cast<double>(walls_.density[i]);
  const auto pressure = static_cast<double>(walls_.pressure[i]);
  Vec3d sum;
  for_each_near(sorted_fluid(), x, [&](std::size_t j, double distance) {
    const Vec3d x_j = fluid_.position.template at<double>(j);
    if (!holds_point(fluid_within_m, x_j)) return;
    const Vec3d r = x_j - x;
    const double g = wendland_gradient_shape(wendland_taper(distance, 0.5 / h));
    const auto viscosity =
        artificial_viscosity(dot(fluid_.velocity.template at<double>(j) - u, r), distance * distance, 0.01 * h * h,
                             density + rho_0 + static_cast<double>(fluid_.density[j]),
                             static_cast<double>(walls_.sound[i]) + static_cast<double>(fluid_.sound[j]));
    const double pressure_j = borne_pressure(pressure, static_cast<double>(fluid_.pressure[j]), least_sum);
    sum += momentum_term(pressure, pressure_j, 1 / density, static_cast<double>(fluid_.volume[j]),
                         viscosity_factor * viscosity.Pi, g) *
           r;
  });
  return (-mass * wendland_gradient_constant({h})) * sum;
}

template <class Pack>
double WcsphSolver<Pack>::wall_particle_pressure_Pa(std::int32_t wall) const {
  const auto i = static_cast<std::size_t>(wall_place_[static_cast<std::size_t>(wall)]);
  return static_cast<double>(walls_.pressure[i]);
}

/// Mean over the first layer of the face on which the point lies, within h of the point.
template <class Pack>
PressureReading WcsphSolver<Pack>::wall_pressure(const Vec3d& point_m) const {
  if (!holds_point(tank_.domain(), point_m)) return {};
  const double h = parameters_.smoothing_length_m();
  const Tank::Face face = tank_.nearest_face(point_m);
  double sum = 0;
  int count = 0;
  for_each_near(sorted_walls().sorted, point_m, [&](std::size_t j, double distance) {
    const Vec3d p = walls_.position.template at<double>(j);
    const double from_face = std::abs(component(p, face.axis) - face.coordinate_m);
    if (wall_layer_[wall_of(j)] != 0 || distance > h || from_face > 0.75 * parameters_.particle_distance_m) return;
    sum += static_cast<double>(walls_.pressure[j]);
    ++count;
  });
  return {count > 0 ? sum / count : 0.0, static_cast<double>(count > 0)};
}

template <class Pack>
FluidTotals WcsphSolver<Pack>::totals() const {
  FluidTotals totals = energies(fluid_.position, fluid_.velocity, 0, fluid_.n, static_cast<double>(constants_.mass),
                                parameters_.gravity_m_s2);
  if (fluid_.n == 0) return totals;
  const auto first = fluid_.density.begin();
  const auto deviation = static_cast<double>(*std::max_element(first, first + static_cast<std::ptrdiff_t>(fluid_.n)));
  totals.greatest_density_ratio = 1 + deviation / parameters_.reference_density_kg_m3;
  return totals;
}

template <class Pack>
ParticleSnapshot WcsphSolver<Pack>::snapshot() const {
  ParticleSnapshot s;
  s.time_s = time_s_;
  s.fluid_count = fluid_.n;
  for (const Particles<Pack>* set : {&fluid_, &walls_}) {
    for (std::size_t i = 0; i < set->n; ++i) {
      s.position_m.push_back(set->position.template at<float>(i));
      s.velocity_m_s.push_back(set->velocity.template at<float>(i));
      s.pressure_Pa.push_back(static_cast<float>(set->pressure[i]));
      s.density_kg_m3.push_back(
          static_cast<float>(parameters_.reference_density_kg_m3 + static_cast<double>(set->density[i])));
      s.id.push_back(set->id[i]);
    }
  }
  return s;
}

template class WcsphSolver<FloatPack>;
template class WcsphSolver<double>;

}  // namespace sluice::wcsph
