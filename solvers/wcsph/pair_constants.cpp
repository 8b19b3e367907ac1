#include <cmath>
#include <limits>

#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/pair_sums.h"

namespace sluice::wcsph {

template <class Pack>
PairConstants<Pack>::PairConstants(const Parameters& p, double quantum_m)
    : tait{p.reference_density_kg_m3, p.speed_of_sound_m_s} {
  const double h = p.smoothing_length_m();
  const double l0 = p.particle_distance_m;
  const double m = p.reference_density_kg_m3 * l0 * l0 * l0;
  const double G0 = wendland_gradient_constant({h});
  half_per_h = Pack(static_cast<Real>(0.5 / h * quantum_m));
  eta2 = Pack(static_cast<Real>(0.01 * (h / quantum_m) * (h / quantum_m)));
  weight_factor = Pack(static_cast<Real>(Wendland{h}.normalisation()));
  mass = static_cast<Real>(m);
  // Pi_ij from distances in quanta is in 1/quantum (approach over distance^2): dividing by the quantum restores metres.
  const double viscosity = m * p.alpha * h / quantum_m;
  momentum_factor = static_cast<Real>(G0 * quantum_m);
  continuity_factor = static_cast<Real>(m * G0 * quantum_m);
  diffusion_factor = static_cast<Real>(2.0 * p.delta * h * p.speed_of_sound_m_s * G0);
  const Pack any_pressure_sum(std::numeric_limits<Real>::lowest() / 4);
  with_fluid = {any_pressure_sum, Pack(static_cast<Real>(viscosity))};
  with_wall = {p.walls == WallModel::extrapolated ? Pack(0) : any_pressure_sum,
               Pack(static_cast<Real>(viscosity * p.wall_friction))};
  mu_factor = h / quantum_m;
  least_pressure = static_cast<Real>(p.least_pressure_Pa());
  least_density = m * wendland_weight(1.0, Wendland{h}.normalisation()) - p.reference_density_kg_m3;
  reference_density = static_cast<Real>(p.reference_density_kg_m3);
  const Vec3d g = p.gravity_m_s2;
  gravity = {static_cast<Real>(g.x), static_cast<Real>(g.y), static_cast<Real>(g.z)};
  gravity_per_quantum = {static_cast<Real>(g.x * quantum_m), static_cast<Real>(g.y * quantum_m),
                         static_cast<Real>(g.z * quantum_m)};
}

template struct PairConstants<double>;
template struct PairConstants<FloatPack>;

}  // namespace sluice::wcsph
