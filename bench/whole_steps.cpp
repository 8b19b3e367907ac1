// Whole time steps of both solvers with every wall model: what a particle costs, where the time goes, what memory is
// held, and how it scales with threads.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/prepared_run.h"
#include "bench/suite.h"

namespace sluice::bench {
namespace {

struct WholeSteps {
  std::string solver;
  std::string walls;
  double particles = 0;
  int threads = 1;
  int steps = 1;

  std::string name_without_threads() const {
    return fmt::format("{}/step/{}/{}", solver, walls, count_name(particles));
  }
};

/// Long enough for some sorts and, at the larger sizes, no longer than need be.
int timed_steps(double particles) {
  return std::clamp(static_cast<int>(3e6 / particles), 3, 30);
}

/// Seconds a step with one thread, for the efficiency of more.
std::map<std::string, double>& single_thread_s() {
  static std::map<std::string, double> times;
  return times;
}

void report(benchmark::State& state, const WholeSteps& w, const Solver& solver, const StepMeter::Reading& r) {
  const auto fluid = static_cast<double>(solver.fluid_count());
  const auto bytes = static_cast<double>(solver.memory_bytes());
  auto& counters = state.counters;
  counters["omp_threads"] = w.threads;
  counters["fluid_particles"] = fluid;
  counters["solid_particles"] = static_cast<double>(solver.solid_count());
  counters["ns_per_particle_step"] = 1e9 * r.wall_s / (r.steps * fluid);
  counters["cpu_ns_per_particle_step"] = 1e9 * r.cpu_s / (r.steps * fluid);
  counters["wall_s_per_simulated_s"] = r.wall_s / r.simulated_s;
  counters["memory_bytes"] = bytes;
  counters["bytes_per_particle"] = bytes / (fluid + static_cast<double>(solver.solid_count()));
  if (r.iterations_a_step > 0) counters["iterations_per_step"] = r.iterations_a_step;
  for (const auto& [phase, phase_s] : r.phases) counters["share_" + phase] = phase_s / r.wall_s;
  const double step_s = r.wall_s / r.steps;
  if (w.threads == 1) single_thread_s()[w.name_without_threads()] = step_s;
  if (const auto one = single_thread_s().find(w.name_without_threads()); one != single_thread_s().end())
    counters["parallel_efficiency"] = one->second / (step_s * w.threads);
}

void time_steps(benchmark::State& state, const WholeSteps& w) {
  const PreparedRun run = prepare(w.solver, w.walls, w.particles, w.threads);
  Solver& solver = *run.solver;
  for (int k = 0; k < 3; ++k) solver.step();
  const StepMeter meter(solver);
  while (state.KeepRunning()) solver.step();
  const StepMeter::Reading reading = meter.read();
  state.SetItemsProcessed(state.iterations() * solver.fluid_count());
  report(state, w, solver, reading);
}

void add(const WholeSteps& w) {
  add_benchmark(w.name_without_threads(), w.threads, [w](benchmark::State& state) { time_steps(state, w); })
      ->Iterations(timed_steps(w.particles))
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void add_whole_steps(const SuiteOptions& options) {
  for (const double particles : options.step_particles)
    for (const int threads : options.threads) {
      add({"wcsph", "extrapolated", particles, threads});
      add({"wcsph", "dynamic", particles, threads});
      add({"mps", "dummies", particles, threads});
    }
}

}  // namespace sluice::bench
