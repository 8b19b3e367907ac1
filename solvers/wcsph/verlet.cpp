#include "solvers/wcsph/verlet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sluice::wcsph {
namespace {

/// The value at t becomes the one before, the new one takes its place.
template <class Real>
void advance_value(Real& at_t, Real& before, Real rate, Real dt_s, VerletForm form) {
  before = std::exchange(at_t, verlet_value(at_t, before, rate, dt_s, form));
}

}  // namespace

template <class Pack>
double advance_fluid(Particles<Pack>& fluid, double dt_s, VerletForm form, double least_density, int threads) {
  using Real = typename Lanes<Pack>::Real;
  const auto dt = static_cast<Real>(dt_s);
  const auto n = static_cast<std::int64_t>(fluid.n);
  double longest2 = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : longest2)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3d u = fluid.velocity.template at<double>(i);
    const Vec3d a = fluid.acceleration.template at<double>(i);
    const Vec3d d{verlet_displacement(u.x, a.x, dt_s), verlet_displacement(u.y, a.y, dt_s),
                  verlet_displacement(u.z, a.z, dt_s)};
    fluid.position.set(i, fluid.position.template at<double>(i) + d);
    longest2 = std::max(longest2, dot(d, d));
    advance_value(fluid.velocity.x[i], fluid.velocity_previous.x[i], fluid.acceleration.x[i], dt, form);
    advance_value(fluid.velocity.y[i], fluid.velocity_previous.y[i], fluid.acceleration.y[i], dt, form);
    advance_value(fluid.velocity.z[i], fluid.velocity_previous.z[i], fluid.acceleration.z[i], dt, form);
    advance_value(fluid.density[i], fluid.density_previous[i], fluid.density_rate[i], dt, form);
    fluid.density[i] = std::max(static_cast<Real>(least_density), fluid.density[i]);
  }
  return std::sqrt(longest2);
}

template <class Pack>
void advance_wall_density(Particles<Pack>& walls, double dt_s, VerletForm form, int threads) {
  using Real = typename Lanes<Pack>::Real;
  const auto dt = static_cast<Real>(dt_s);
  const auto n = static_cast<std::int64_t>(walls.n);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    advance_value(walls.density[i], walls.density_previous[i], walls.density_rate[i], dt, form);
    walls.density[i] = std::max(Real(0), walls.density[i]);
  }
}

template double advance_fluid(Particles<double>&, double, VerletForm, double, int);
template double advance_fluid(Particles<FloatPack>&, double, VerletForm, double, int);
template void advance_wall_density(Particles<double>&, double, VerletForm, int);
template void advance_wall_density(Particles<FloatPack>&, double, VerletForm, int);

}  // namespace sluice::wcsph
