// Sums over the neighbours of fluid particles.
#include <algorithm>
#include <cmath>

#include "solvers/wcsph/neighbour_packs.h"
#include "solvers/wcsph/terms.h"

namespace sluice::wcsph {
namespace {

/// What a fluid particle gathers over its neighbours.
template <class Pack>
struct FluidSums {
  Vec3<Pack> momentum{Pack(0), Pack(0), Pack(0)};
  Pack continuity{0};
  Pack diffusion{0};
};

/// The terms of a pack of pairs.
template <class Pack>
struct PairTerms {
  Pack g;         ///< shape of the kernel's gradient
  Pack approach;  ///< u_ij . r_ij
  Pack force;     ///< of Eq. (3), to be taken times r_ij
};

/// largest_mu, shared by all particles of a thread, grows where a pair's |mu| / h exceeds it: that is rare, and so a
/// test is cheaper than a maximum for every pair.
template <class Pack>
[[gnu::always_inline]] inline PairTerms<Pack> pair_terms(const Target<Pack>& i, const Particles<Pack>& neighbours,
                                                         std::size_t j, const Pairs<Pack>& p,
                                                         const PairConstants<Pack>& c, const PairLaw<Pack>& law,
                                                         Pack& largest_mu) {
  using L = Lanes<Pack>;
  const Vec3<Pack> velocity{L::load(&neighbours.velocity.x[j]), L::load(&neighbours.velocity.y[j]),
                            L::load(&neighbours.velocity.z[j])};
  const Pack g = wendland_gradient_shape(p.taper);
  const Pack approach = dot(velocity - i.velocity, p.r);
  const auto viscosity = artificial_viscosity(approach, p.distance2, c.eta2,
                                              i.density_and_twice_reference + L::load(&neighbours.density[j]),
                                              i.sound + L::load(&neighbours.sound[j]));
  const Pack mu = magnitude(viscosity.mu);
  if (any_larger(mu, largest_mu, p.taper)) largest_mu = Pack(lane_max(larger(where_positive(p.taper, mu), largest_mu)));
  const Pack pressure = larger(L::load(&neighbours.pressure[j]), law.least_pressure_sum - i.pressure);
  const Pack force = momentum_term(i.pressure, pressure, i.inverse_density, L::load(&neighbours.volume[j]),
                                   law.viscosity_factor * viscosity.Pi, g);
  return {g, approach, force};
}

/// Fluid with fluid: each pair is visited once, and what i gathers, j is handed with the opposite sign where it has
/// one.
template <class Pack>
void sum_fluid_pairs(const Target<Pack>& i, Particles<Pack>& fluid, const PackList<Pack>& packs,
                     const PairConstants<Pack>& c, FluidSums<Pack>& into, Pack& largest_mu) {
  using L = Lanes<Pack>;
  FluidSums<Pack> sums;
  Pack largest = largest_mu;
  for (const PackOfRun& pack : packs) {
    const auto j = static_cast<std::size_t>(pack.begin);
    const Pairs<Pack> p = pairs(i.x, fluid, pack, c);
    const PairTerms<Pack> t = pair_terms(i, fluid, j, p, c, c.with_fluid, largest);
    const Vec3<Pack> momentum = t.force * p.r;
    sums.momentum += momentum;
    L::add(&fluid.acceleration.x[j], -momentum.x, pack.count);
    L::add(&fluid.acceleration.y[j], -momentum.y, pack.count);
    L::add(&fluid.acceleration.z[j], -momentum.z, pack.count);

    const Pack density = L::load(&fluid.density[j]);
    const Pack continuity = continuity_term(t.g, t.approach);
    sums.continuity += continuity;
    sums.diffusion += diffusion_term(i.density, density, L::load(&fluid.volume[j]), t.g);
    L::add(&fluid.density_rate[j],
           c.continuity_factor * continuity + c.diffusion_factor * diffusion_term(density, i.density, i.volume, t.g),
           pack.count);
  }
  into = sums;
  largest_mu = largest;
}

/// Fluid with walls: one-sided, and without diffusion.
template <class Pack>
void sum_wall_pairs(const Target<Pack>& i, const Particles<Pack>& walls, const PackList<Pack>& packs,
                    const PairConstants<Pack>& c, FluidSums<Pack>& into, Pack& largest_mu) {
  FluidSums<Pack> sums = into;
  Pack largest = largest_mu;
  for (const PackOfRun& pack : packs) {
    const Pairs<Pack> p = pairs(i.x, walls, pack, c);
    const PairTerms<Pack> t = pair_terms(i, walls, static_cast<std::size_t>(pack.begin), p, c, c.with_wall, largest);
    sums.momentum += t.force * p.r;
    sums.continuity += continuity_term(t.g, t.approach);
  }
  into = sums;
  largest_mu = largest;
}

/// Adds one particle's sums to what its pairs with earlier particles have left there.
template <class Pack>
void add_sums(Particles<Pack>& fluid, std::size_t i, const FluidSums<Pack>& sums, const PairConstants<Pack>& c) {
  fluid.acceleration.x[i] += lane_sum(sums.momentum.x);
  fluid.acceleration.y[i] += lane_sum(sums.momentum.y);
  fluid.acceleration.z[i] += lane_sum(sums.momentum.z);
  fluid.density_rate[i] += lane_sum(c.continuity_factor * sums.continuity + c.diffusion_factor * sums.diffusion);
}

/// The runs of the rows that come after the own one, and of the own row what comes after particle i: with them each
/// pair is visited once. All lie in the own slab (the rows at one y) or in the next.
inline Runs forward(Runs runs, std::size_t i) {
  for (const std::size_t k : {0U, 1U, 3U, 6U}) runs[k] = {};
  runs[4].begin = static_cast<std::int32_t>(i) + 1;
  return runs;
}

/// All pairs of the fluid particles of one row.
template <class Pack>
void sum_row(Particles<Pack>& fluid, const Sorted<Pack>& fluid_neighbours, const Sorted<Pack>& wall_neighbours,
             std::int32_t row, const PairConstants<Pack>& c, PackList<Pack>& packs, Pack& largest_mu) {
  const Run targets = fluid_neighbours.index.row(row);
  for (auto i = static_cast<std::size_t>(targets.begin); i < static_cast<std::size_t>(targets.end); ++i) {
    const Target<Pack> target(fluid, i, c);
    const Vec3d x = fluid.position.template at<double>(i);
    FluidSums<Pack> sums;
    packs.list(forward(fluid_neighbours.index.neighbours(x, row, fluid_neighbours.travel_m), i));
    sum_fluid_pairs(target, fluid, packs, c, sums, largest_mu);
    if (wall_neighbours.index.any_near(x)) {
      packs.list(wall_neighbours.index.neighbours(x, wall_neighbours.travel_m));
      sum_wall_pairs(target, wall_neighbours.particles, packs, c, sums, largest_mu);
    }
    add_sums(fluid, i, sums, c);
  }
}

template <class Pack>
void clear_rates(Particles<Pack>& fluid, int threads) {
  const auto n = static_cast<std::int64_t>(fluid.n);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    fluid.acceleration.set(i, Vec3<typename Lanes<Pack>::Real>{});
    fluid.density_rate[i] = 0;
  }
}

/// From sums to rates: dv/dt = g - G0 sum. Returns the largest acceleration [m/s^2].
template <class Pack>
double finish_rates(Particles<Pack>& fluid, const PairConstants<Pack>& c, int threads) {
  using Real = typename Lanes<Pack>::Real;
  double acceleration2 = 0;
  const auto n = static_cast<std::int64_t>(fluid.n);
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : acceleration2)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3<Real> a = c.gravity - c.momentum_factor * fluid.acceleration.template at<Real>(i);
    fluid.acceleration.set(i, a);
    acceleration2 = std::max(acceleration2, static_cast<double>(dot(a, a)));
  }
  return std::sqrt(acceleration2);
}

}  // namespace

template <class Pack>
StepLimits sum_fluid_rates(Particles<Pack>& fluid, const Sorted<Pack>& fluid_neighbours,
                           const Sorted<Pack>& wall_neighbours, const PairConstants<Pack>& constants, int threads) {
  const RowGeometry& geometry = fluid_neighbours.index.geometry();
  clear_rates(fluid, threads);
  double mu = 0;
#pragma omp parallel num_threads(threads) reduction(max : mu)
  {
    const PairConstants<Pack> c = constants;
    PackList<Pack> packs;
    Pack largest_mu(0);
    // A slab writes to itself and to the next one. So even slabs run side by side, and odd ones after them: whatever
    // the number of threads, every particle receives its terms in the same order.
    for (const std::int32_t parity : {0, 1}) {
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t slab = parity; slab < geometry.ny; slab += 2) {
        for (std::int32_t z = 0; z < geometry.nz; ++z) {
          sum_row(fluid, fluid_neighbours, wall_neighbours, z * geometry.ny + slab, c, packs, largest_mu);
        }
      }
    }
    mu = static_cast<double>(lane_max(largest_mu)) * c.mu_factor;
  }
  return {finish_rates(fluid, constants, threads), mu};
}

template StepLimits sum_fluid_rates(Particles<double>&, const Sorted<double>&, const Sorted<double>&,
                                    const PairConstants<double>&, int);
template StepLimits sum_fluid_rates(Particles<FloatPack>&, const Sorted<FloatPack>&, const Sorted<FloatPack>&,
                                    const PairConstants<FloatPack>&, int);

}  // namespace sluice::wcsph
