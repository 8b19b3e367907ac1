// Sums over the fluid neighbours of wall particles, for both wall models.
#include <algorithm>
#include <array>
#include <span>

#include "solvers/wcsph/neighbour_packs.h"
#include "solvers/wcsph/terms.h"

namespace sluice::wcsph {
namespace {

/// Sum of the continuity term over the fluid around one wall particle.
template <class Pack>
auto wall_continuity(const Target<Pack>& wall, const Particles<Pack>& fluid, const PackList<Pack>& packs,
                     const PairConstants<Pack>& c) {
  Pack sum(0);
  for (const PackOfRun& pack : packs) {
    const Pairs<Pack> p = pairs(wall.x, fluid, pack, c);
    const Neighbours<Pack> j(fluid, static_cast<std::size_t>(pack.begin));
    sum += continuity_term(wendland_gradient_shape(p.taper), dot(j.velocity - wall.velocity, p.r));
  }
  return lane_sum(sum);
}

/// Kernel mean of the pressure that the fluid hands to one wall particle, not below zero   [Pa]. Walls move at constant
/// velocity: their own acceleration is left out.
template <class Pack>
auto wall_pressure(const Target<Pack>& wall, const Particles<Pack>& fluid, const PackList<Pack>& packs,
                   const PairConstants<Pack>& c) {
  const Vec3<Pack> gravity{Pack(c.gravity_per_quantum.x), Pack(c.gravity_per_quantum.y), Pack(c.gravity_per_quantum.z)};
  Pack weights(0);
  Pack pressures(0);
  for (const PackOfRun& pack : packs) {
    const Pairs<Pack> p = pairs(wall.x, fluid, pack, c);
    const Neighbours<Pack> j(fluid, static_cast<std::size_t>(pack.begin));
    const Pack W = wendland_weight(p.taper, c.weight_factor);
    const Pack density = j.density + Pack(c.reference_density);
    weights += W;
    pressures += W * extrapolated_pressure(j.pressure, density, gravity, {-p.r.x, -p.r.y, -p.r.z});
  }
  using Real = typename Lanes<Pack>::Real;
  const Real weight = lane_sum(weights);
  return weight > 0 ? std::max(Real(0), lane_sum(pressures) / weight) : Real(0);
}

/// So many wet walls are taken at a time by a thread.
constexpr std::size_t walls_at_once = 256;

/// Calls value(i, packs) for every wet wall particle i and hands the values of up to walls_at_once of them, with a pack
/// to spare, to store(indices, values). Each particle's packs are listed before the sums of the one before it, so that
/// the search's latency is hidden behind them.
template <class Pack, class Value, class Store>
void for_wet_walls(const Particles<Pack>& walls, std::span<const std::int32_t> wet,
                   const Sorted<Pack>& fluid_neighbours, int threads, const Value& value, const Store& store) {
  using L = Lanes<Pack>;
  const auto blocks = static_cast<std::int64_t>((wet.size() + walls_at_once - 1) / walls_at_once);
#pragma omp parallel num_threads(threads)
  {
    std::array<PackList<Pack>, 2> packs;
    std::array<typename L::Real, walls_at_once + L::width> values{};
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::size_t first = static_cast<std::size_t>(b) * walls_at_once;
      const auto block = wet.subspan(first, std::min(walls_at_once, wet.size() - first));
      const auto list = [&](std::size_t k) {
        const Vec3d x = walls.position.template at<double>(static_cast<std::size_t>(block[k]));
        packs[k % 2].list(fluid_neighbours.index.neighbours(x, fluid_neighbours.travel_m));
      };
      list(0);
      for (std::size_t k = 0; k < block.size(); ++k) {
        if (k + 1 < block.size()) list(k + 1);
        values[k] = value(static_cast<std::size_t>(block[k]), packs[k % 2]);
      }
      store(block, std::span(values));
    }
  }
}

}  // namespace

template <class Pack>
void sum_wall_density_rates(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                            const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads) {
  using Real = typename Lanes<Pack>::Real;
  const auto rate = [&](std::size_t i, const PackList<Pack>& packs) {
    return c.continuity_factor * wall_continuity(Target<Pack>(walls, i, c), fluid_neighbours.particles, packs, c);
  };
  const auto store = [&](std::span<const std::int32_t> block, std::span<const Real> rates) {
    for (std::size_t k = 0; k < block.size(); ++k) walls.density_rate[static_cast<std::size_t>(block[k])] = rates[k];
  };
  for_wet_walls(walls, wet, fluid_neighbours, threads, rate, store);
}

template <class Pack>
void extrapolate_wall_pressures(Particles<Pack>& walls, std::span<const std::int32_t> wet,
                                const Sorted<Pack>& fluid_neighbours, const PairConstants<Pack>& c, int threads) {
  using L = Lanes<Pack>;
  using Real = typename L::Real;
  const auto pressure = [&](std::size_t i, const PackList<Pack>& packs) {
    return wall_pressure(Target<Pack>(walls, i, c), fluid_neighbours.particles, packs, c);
  };
  const auto store = [&](std::span<const std::int32_t> block, std::span<Real> values) {
    for (std::size_t k = 0; k < block.size(); k += L::width)
      L::store(tait_density_deviation(L::load(&values[k]), c.tait), &values[k]);
    for (std::size_t k = 0; k < block.size(); ++k) walls.density[static_cast<std::size_t>(block[k])] = values[k];
  };
  for_wet_walls(walls, wet, fluid_neighbours, threads, pressure, store);
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
