// The kernels of a WCSPH step, each alone, on the particles of a disordered dam break.
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "bench/pair_costs.h"
#include "bench/prepared_run.h"
#include "bench/suite.h"
#include "solvers/wcsph/verlet.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice::bench {
namespace {

using wcsph::Particles;
using Solver = wcsph::WcsphSolver<FloatPack>;

constexpr int steps_before = 3;  // so that rates and pressures are those of a run

/// A solver after a few steps, and copies of its particles to work on.
struct State {
  State(const std::string& walls_model, double particles, int thread_count)
      : run(prepare("wcsph", walls_model, particles, thread_count)),
        solver(dynamic_cast<Solver&>(*run.solver)),
        threads(thread_count) {
    for (int k = 0; k < steps_before; ++k) solver.step();
    fluid = solver.fluid();
    walls = solver.walls();
  }
  double n() const { return static_cast<double>(fluid.n); }
  wcsph::Sorted<FloatPack> sorted_fluid() const {
    const auto sorted = solver.sorted_fluid();
    return {fluid, sorted.index, sorted.travel_m};
  }

  PreparedRun run;
  Solver& solver;
  int threads;
  Particles<FloatPack> fluid;
  Particles<FloatPack> walls;
};

/// What a sum over neighbours meets.
struct Encounters {
  double pairs = 0;   ///< ordered pairs (target, other) within the kernel's radius, a target itself among its others
  double others = 0;  ///< different particles that lie within the radius of any target
};

Encounters encounters(const VectorField<double>& targets, std::span<const std::int32_t> which,
                      const wcsph::Sorted<FloatPack>& others) {
  const double radius2 = others.index.geometry().radius_m * others.index.geometry().radius_m;
  std::vector<std::uint8_t> met(others.particles.n, 0);
  std::int64_t pairs = 0;
  for (const std::int32_t k : which) {
    const Vec3d x = targets.at<double>(static_cast<std::size_t>(k));
    for (const Run& run : others.index.neighbours(x, others.travel_m))
      for (auto j = static_cast<std::size_t>(run.begin); j < static_cast<std::size_t>(run.end); ++j) {
        const Vec3d r = others.particles.position.at<double>(j) - x;
        if (dot(r, r) >= radius2) continue;
        ++pairs;
        met[j] = 1;
      }
  }
  return {static_cast<double>(pairs), static_cast<double>(std::count(met.begin(), met.end(), 1))};
}

std::vector<std::int32_t> all(std::size_t n) {
  std::vector<std::int32_t> which(n);
  for (std::size_t k = 0; k < n; ++k) which[k] = static_cast<std::int32_t>(k);
  return which;
}

// Bytes a particle that a sum reads of its neighbours: fixed-point coordinates (12) and what its terms take.
constexpr double coordinates = 12;
constexpr double velocity_and_four_scalars = 12 + 4 * 4;  // density, pressure, volume, speed of sound

Kernel fluid_pairs(double particles, int threads) {
  const auto s = std::make_shared<State>("extrapolated", particles, threads);
  const auto which = all(s->fluid.n);
  const Encounters fluid = encounters(s->fluid.position, which, s->sorted_fluid());
  const Encounters walls = encounters(s->fluid.position, which, s->solver.sorted_walls().sorted);
  // Rates (16) are cleared, summed (read and written), and finished (acceleration 12, read and written); positions in
  // double (24) start the search.
  const double bytes = s->n() * (24 + coordinates + velocity_and_four_scalars + 16 + 32 + 24) +
                       walls.others * (coordinates + velocity_and_four_scalars);
  const double operations =
      (fluid.pairs - s->n()) / 2 * operations_of_fluid_pair() + walls.pairs * operations_of_fluid_and_wall();
  return {[s] {
            sum_fluid_rates(s->fluid, s->sorted_fluid(), s->solver.sorted_walls(), s->solver.constants(), s->threads);
          },
          {s->n(), bytes, operations}};
}

/// One sum for every wall particle that fluid can reach; items are those.
Kernel wall_sums(const std::string& model, double particles, int threads) {
  const auto s = std::make_shared<State>(model, particles, threads);
  const auto wet = s->solver.wet_walls();
  const Encounters fluid = encounters(s->walls.position, wet, s->sorted_fluid());
  const auto items = static_cast<double>(wet.size());
  const bool extrapolated = model == "extrapolated";
  // Its position, its coordinates and the result; of the fluid coordinates and pressure and density, or velocity.
  const double bytes = items * (24 + coordinates + 4) + fluid.others * (coordinates + (extrapolated ? 8 : 12));
  const double a_pair = extrapolated ? operations_of_extrapolated_pressure() : operations_of_wall_continuity();
  return {[s, wet, extrapolated] {
            if (extrapolated)
              extrapolate_wall_pressures(s->walls, wet, s->sorted_fluid(), s->solver.constants(), s->threads);
            else
              sum_wall_density_rates(s->walls, wet, s->sorted_fluid(), s->solver.constants(), s->threads);
          },
          {items, bytes, fluid.pairs * a_pair}};
}

/// A sort of what is nearly sorted, as in a run, and the permutation of all that is carried.
Kernel sort(double particles, int threads) {
  const auto s = std::make_shared<State>("extrapolated", particles, threads);
  const auto index = std::make_shared<RowIndex>(s->solver.sorted_fluid().index.geometry());
  const std::vector<std::uint8_t> leaves(s->fluid.n, 0);
  // The sort reads positions (24) and flags (1) and writes and reads two orders (16); what is carried (positions 24,
  // two velocities 24, two densities 8, id 4) is read and written.
  const double bytes = s->n() * (24 + 1 + 16 + 2 * (24 + 24 + 8 + 4));
  return {[s, index, leaves] {
            const auto& x = s->fluid.position;
            index->sort(x.x, x.y, x.z, leaves, s->threads);
            s->fluid.permute(index->order(), s->threads);
          },
          {s->n(), bytes, 0}};
}

/// A time step of length zero, which costs what any other does.
Kernel advance(double particles, int threads) {
  const auto s = std::make_shared<State>("extrapolated", particles, threads);
  // Positions (24), both velocities (24) and both densities (8) read and written, rates (16) read.
  const double bytes = s->n() * (2 * (24 + 24 + 8) + 16);
  // A component: 2 + 2 of the displacement, 1 of the position, 2 of the leap (2 dt is a constant); 2 + 1 of the
  // density and its floor; 5 + 1 of the longest displacement.
  const double operations = s->n() * (3 * 7 + 3 + 6);
  return {[s] { advance_fluid(s->fluid, 0.0, wcsph::VerletForm::leap, -1000, s->threads); },
          {s->n(), bytes, operations}};
}

/// One reading of all sensors of the case; an item is a reading of one of them.
Kernel sensors(double particles, int threads) {
  const auto s = std::make_shared<State>("extrapolated", particles, threads);
  const auto values = std::make_shared<std::vector<double>>();
  return {[s, values] { s->run.sensors.sample(s->solver, *values); },
          {static_cast<double>(s->run.sensors.placed().size()), 0, 0}};
}

}  // namespace

void add_wcsph_kernels(const SuiteOptions& options) {
  add_kernel("wcsph/fluid_pairs", options, fluid_pairs);
  add_kernel("wcsph/wall_pressures", options,
             [](double n, int threads) { return wall_sums("extrapolated", n, threads); });
  add_kernel("wcsph/wall_density_rates", options,
             [](double n, int threads) { return wall_sums("dynamic", n, threads); });
  add_kernel("wcsph/sort", options, sort);
  add_kernel("wcsph/advance", options, advance);
  add_kernel("wcsph/sensors", options, sensors);
}

}  // namespace sluice::bench
