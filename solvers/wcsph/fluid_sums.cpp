// Sums over the neighbours of fluid particles.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

/// largest_mu, shared by all particles of a thread, grows where a pair's |mu| / h exceeds it: that is rare, and so a
/// test is cheaper than a maximum for every pair.
template <class Pack>
[[gnu::always_inline]] inline Pack pair_force(const Target<Pack>& i, const Neighbours<Pack>& j, const Pairs<Pack>& p,
                                              const Pack& g, const Pack& approach, const PairConstants<Pack>& c,
                                              const PairLaw<Pack>& law, Pack& largest_mu) {
  const auto viscosity =
      artificial_viscosity(approach, p.distance2, c.eta2, i.density_and_twice_reference + j.density, i.sound + j.sound);
  const Pack mu = magnitude(viscosity.mu);
  if (any_larger(mu, largest_mu, p.taper)) largest_mu = Pack(lane_max(larger(where_positive(p.taper, mu), largest_mu)));
  const Pack pressure = borne_pressure(i.pressure, j.pressure, law.least_pressure_sum);
  return momentum_term(i.pressure, pressure, i.inverse_density, j.volume, law.viscosity_factor * viscosity.Pi, g);
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
    const auto at = static_cast<std::size_t>(pack.begin);
    const auto window = L::window(pack.writable);
    const Pairs<Pack> p = pairs(i.x, fluid, pack, c);
    const Neighbours<Pack> j(fluid, at);
    const Pack g = wendland_gradient_shape(p.taper);
    const Pack approach = dot(j.velocity - i.velocity, p.r);
    const Vec3<Pack> momentum = pair_force(i, j, p, g, approach, c, c.with_fluid, largest) * p.r;
    const Pack continuity = continuity_term(g, approach);
    const Pack rate =
        c.continuity_factor * continuity + c.diffusion_factor * diffusion_term(j.density, i.density, i.volume, g);
    sums.momentum += momentum;
    sums.continuity += continuity;
    sums.diffusion += diffusion_term(i.density, j.density, j.volume, g);
    L::add(&fluid.acceleration.x[at], -momentum.x, window);
    L::add(&fluid.acceleration.y[at], -momentum.y, window);
    L::add(&fluid.acceleration.z[at], -momentum.z, window);
    L::add(&fluid.density_rate[at], rate, window);
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
    const Neighbours<Pack> j(walls, static_cast<std::size_t>(pack.begin));
    const Pack g = wendland_gradient_shape(p.taper);
    const Pack approach = dot(j.velocity - i.velocity, p.r);
    sums.momentum += pair_force(i, j, p, g, approach, c, c.with_wall, largest) * p.r;
    sums.continuity += continuity_term(g, approach);
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

/// The loop over the particles of a run. Each particle's packs are listed before the sums of the one before it, so that
/// the search's latency is hidden behind them.
template <class Pack>
class RunSums {
 public:
  RunSums(Particles<Pack>& fluid, const Sorted<Pack>& fluid_neighbours, const SortedWalls<Pack>& walls,
          const PairConstants<Pack>& constants)
      : fluid_(fluid), neighbours_(fluid_neighbours), walls_(walls), c_(constants) {}

  /// Sums for particles of one row. Terms of zero may be added to whatever lies before free_slice in the rows that are
  /// reached.
  void sum(const Run& targets, std::int32_t row_y, std::int32_t row_z, std::int32_t free_slice) {
    if (targets.begin == targets.end) return;
    const auto end = static_cast<std::size_t>(targets.end);
    const RowIndex::Row search = neighbours_.index.row_search(row_y, row_z);
    free_ends_ = neighbours_.index.forward_starts(search, free_slice);
    list(static_cast<std::size_t>(targets.begin), search);
    for (auto i = static_cast<std::size_t>(targets.begin); i < end; ++i) {
      if (i + 1 < end) list(i + 1, search);
      sum_particle(i);
    }
  }
  const Pack& largest_mu() const { return largest_mu_; }

 private:
  void list(std::size_t i, const RowIndex::Row& search) {
    const Vec3d x = fluid_.position.template at<double>(i);
    ForwardRuns runs = neighbours_.index.forward(x, search, neighbours_.travel_m);
    runs.front().begin = static_cast<std::int32_t>(i) + 1;
    packs_[i % 2].list(runs, free_ends_);
    wall_packs_[i % 2].clear();
    if (walls_.proximity.any_near(x)) {
      wall_packs_[i % 2].list(walls_.sorted.index.neighbours(x, walls_.sorted.travel_m));
    }
  }

  void sum_particle(std::size_t i) {
    const Target<Pack> target(fluid_, i, c_);
    FluidSums<Pack> sums;
    sum_fluid_pairs(target, fluid_, packs_[i % 2], c_, sums, largest_mu_);
    if (!wall_packs_[i % 2].empty()) {
      sum_wall_pairs(target, walls_.sorted.particles, wall_packs_[i % 2], c_, sums, largest_mu_);
    }
    add_sums(fluid_, i, sums, c_);
  }

  Particles<Pack>& fluid_;
  const Sorted<Pack>& neighbours_;
  const SortedWalls<Pack>& walls_;
  const PairConstants<Pack> c_;
  std::array<PackList<Pack>, 2> packs_;
  std::array<PackList<Pack>, 2> wall_packs_;
  ForwardStarts free_ends_{};
  Pack largest_mu_{0};
};

/// Blocks of the fluid that write to themselves and to their neighbours only: `length` slices of all rows at one y.
/// Blocks of one colour have others between them and run side by side, colour after colour, so that every particle
/// receives its terms in the same order whatever the number of threads.
struct Blocks {
  static constexpr std::int32_t y_colours = reach_rows + 1;
  static constexpr std::int32_t colours = 2 * y_colours;

  explicit Blocks(const RowGeometry& geometry) : g(geometry) {
    const double reach = 2 * (g.radius_m + 2 * g.slack_m) / g.slice_m + 2;  // so that a block between two parts them
    length = std::max(static_cast<std::int32_t>(reach) + 1, 48);
    along_x = (g.nx + length - 1) / length;
  }
  std::int32_t count(std::int32_t colour) const { return of(along_x, 2, colour % 2) * of(g.ny, y_colours, colour / 2); }
  /// Slab and first slice of block b of a colour.
  std::pair<std::int32_t, std::int32_t> place(std::int32_t colour, std::int32_t b) const {
    const std::int32_t n = of(along_x, 2, colour % 2);
    return {colour / 2 + y_colours * (b / n), length * (colour % 2 + 2 * (b % n))};
  }
  /// The first slice that a block which begins at `slice` must leave to the next one of its colour: the middle between
  /// them, which neither reaches.
  std::int32_t free_slice(std::int32_t slice) const { return std::min(slice + length + length / 2, g.nx); }
  /// How many of 0 .. n - 1 are `rest` modulo `divisor`.
  static std::int32_t of(std::int32_t n, std::int32_t divisor, std::int32_t rest) {
    return (n - rest + divisor - 1) / divisor;
  }

  const RowGeometry& g;
  std::int32_t length = 0;
  std::int32_t along_x = 0;
};

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
StepLimits sum_fluid_rates(Particles<Pack>& fluid, const Sorted<Pack>& fluid_neighbours, const SortedWalls<Pack>& walls,
                           const PairConstants<Pack>& constants, int threads) {
  const RowGeometry& geometry = fluid_neighbours.index.geometry();
  const Blocks blocks(geometry);
  clear_rates(fluid, threads);
  double mu = 0;
#pragma omp parallel num_threads(threads) reduction(max : mu)
  {
    RunSums<Pack> sums(fluid, fluid_neighbours, walls, constants);
    for (std::int32_t colour = 0; colour < Blocks::colours; ++colour) {
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t b = 0; b < blocks.count(colour); ++b) {
        const auto [slab, slice] = blocks.place(colour, b);
        for (std::int32_t z = 0; z < geometry.nz; ++z) {
          const std::int32_t row = geometry.row_at(slab, z);
          const Run targets = fluid_neighbours.index.slices(row, slice, std::min(slice + blocks.length, geometry.nx));
          sums.sum(targets, slab, z, blocks.free_slice(slice));
        }
      }
    }
    mu = static_cast<double>(lane_max(sums.largest_mu())) * constants.mu_factor;
  }
  return {finish_rates(fluid, constants, threads), mu};
}

template StepLimits sum_fluid_rates(Particles<double>&, const Sorted<double>&, const SortedWalls<double>&,
                                    const PairConstants<double>&, int);
template StepLimits sum_fluid_rates(Particles<FloatPack>&, const Sorted<FloatPack>&, const SortedWalls<FloatPack>&,
                                    const PairConstants<FloatPack>&, int);

}  // namespace sluice::wcsph
