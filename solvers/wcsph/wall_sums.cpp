// Sums over the fluid neighbours of wall particles, for both wall models.
#include <algorithm>

#include "solvers/wcsph/neighbour_packs.h"
#include "solvers/wcsph/terms.h"

namespace sluice::wcsph {
namespace {

/// Sum of the continuity term over the fluid around one wall particle.
template <class Pack>
auto wall_continuity(const Target<Pack>& wall, const Particles<Pack>& fluid, const PackList<Pack>& packs,
                     const PairConstants<Pack>& c) {
  using L = Lanes<Pack>;
  Pack sum(0);
  for (const PackOfRun& pack : packs) {
    const auto j = static_cast<std::size_t>(pack.begin);
    const Pairs<Pack> p = pairs(wall.x, fluid, pack, c);
    const Vec3<Pack> velocity{L::load(&fluid.velocity.x[j]), L::load(&fluid.velocity.y[j]),
                              L::load(&fluid.velocity.z[j])};
    sum += continuity_term(wendland_gradient_shape(p.taper), dot(velocity - wall.velocity, p.r));
  }
  return lane_sum(sum);
}

/// Kernel mean of the pressure that the fluid hands to one wall particle, not below zero   [Pa]
template <class Pack>
auto wall_pressure(const Target<Pack>& wall, const Particles<Pack>& fluid, const PackList<Pack>& packs,
                   const PairConstants<Pack>& c) {
  using L = Lanes<Pack>;
  const Vec3<Pack> gravity{Pack(c.gravity_per_quantum.x), Pack(c.gravity_per_quantum.y), Pack(c.gravity_per_quantum.z)};
  Pack weights(0);
  Pack pressures(0);
  for (const PackOfRun& pack : packs) {
    const auto j = static_cast<std::size_t>(pack.begin);
    const Pairs<Pack> p = pairs(wall.x, fluid, pack, c);
    const Pack W = wendland_weight(p.taper, c.weight_factor);
    const Pack density = L::load(&fluid.density[j]) + Pack(c.reference_density);
    weights += W;
    pressures += W * extrapolated_pressure(L::load(&fluid.pressure[j]), density, gravity, {-p.r.x, -p.r.y, -p.r.z});
  }
  using Real = typename L::Real;
  const Real weight = lane_sum(weights);
  return weight > 0 ? std::max(Real(0), lane_sum(pressures) / weight) : Real(0);
}

}  // namespace

template <class Pack>
void sum_wall_density_rates(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                            const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads) {
  const auto n = static_cast<std::int64_t>(wet.size());
#pragma omp parallel num_threads(threads)
  {
    PackList<Pack> packs;
#pragma omp for schedule(dynamic, 256)
    for (std::int64_t w = 0; w < n; ++w) {
      const auto i = static_cast<std::size_t>(wet[static_cast<std::size_t>(w)]);
      packs.list(fluid_neighbours.index.neighbours(walls.position.template at<double>(i), fluid_neighbours.travel_m));
      walls.density_rate[i] =
          c.continuity_factor * wall_continuity(Target<Pack>(walls, i, c), fluid_neighbours.particles, packs, c);
    }
  }
}

template <class Pack>
void extrapolate_wall_pressures(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                                const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads) {
  using Real = typename Lanes<Pack>::Real;
  const auto n = static_cast<std::int64_t>(wet.size());
#pragma omp parallel num_threads(threads)
  {
    PackList<Pack> packs;
#pragma omp for schedule(dynamic, 256)
    for (std::int64_t w = 0; w < n; ++w) {
      const auto i = static_cast<std::size_t>(wet[static_cast<std::size_t>(w)]);
      packs.list(fluid_neighbours.index.neighbours(walls.position.template at<double>(i), fluid_neighbours.travel_m));
      const Real pressure = wall_pressure(Target<Pack>(walls, i, c), fluid_neighbours.particles, packs, c);
      walls.density[i] = pressure > 0 ? tait_density_deviation(pressure, c.tait) : Real(0);
    }
  }
}

template void sum_wall_density_rates(Particles<double>&, std::span<const std::int32_t>, const Sorted<double>&,
                                     const PairConstants<double>&, int);
template void sum_wall_density_rates(Particles<FloatPack>&, std::span<const std::int32_t>, const Sorted<FloatPack>&,
                                     const PairConstants<FloatPack>&, int);
template void extrapolate_wall_pressures(Particles<double>&, std::span<const std::int32_t>, const Sorted<double>&,
                                         const PairConstants<double>&, int);
template void extrapolate_wall_pressures(Particles<FloatPack>&, std::span<const std::int32_t>, const Sorted<FloatPack>&,
                                         const PairConstants<FloatPack>&, int);

}  // namespace sluice::wcsph
