// Whole time steps a second: sums, sort, stepping and sensors, over a stretch of a run, on each number of threads asked
// for. The stretch should lie in disordered flow: on the initial lattice every code is up to twice as fast.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <string>
#include <vector>

#include "bench/prepared_run.h"
#include "validation/case.h"
#include "validation/run_settings.h"
#include "validation/sensors.h"

namespace {

using namespace sluice;

struct Stretch {
  double from_s = 0.2;
  double to_s = 0.3;
  double jitter = 0;  ///< in particle distances
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Steps to a time, reading the sensors at the case's rate; returns the seconds that the sensors took.
double run_to(Solver& solver, const SensorArray& sensors, double to_s, double rate_Hz) {
  double sensors_s = 0;
  std::vector<double> values;
  double next_s = solver.time_s();
  while (solver.time_s() < to_s) {
    solver.step();
    if (solver.time_s() < next_s) continue;
    const auto start = std::chrono::steady_clock::now();
    sensors.sample(solver, values);
    sensors_s += seconds_since(start);
    next_s += 1 / rate_Hz;
  }
  return sensors_s;
}

void measure(const Case& c, const RunSettings& settings, const Stretch& stretch) {
  const bench::PreparedRun run(c, settings, stretch.jitter);
  Solver& solver = *run.solver;
  run_to(solver, run.sensors, stretch.from_s, settings.output_rate_Hz);
  const bench::StepMeter meter(solver);
  const double sensors_s = run_to(solver, run.sensors, stretch.to_s, settings.output_rate_Hz);
  const bench::StepMeter::Reading r = meter.read();

  const auto fluid = static_cast<double>(solver.fluid_count());
  const auto bytes = static_cast<double>(solver.memory_bytes());
  fmt::print("{} {} walls, l0 = {} m, {} threads: {:.0f} fluid and {} solid particles\n", settings.solver,
             settings.walls, settings.l0_m, settings.threads, fluid, solver.solid_count());
  fmt::print("  {:8.3f} million fluid particle-steps a second ({:.0f} steps in {:.2f} s)\n",
             1e-6 * fluid * r.steps / r.wall_s, r.steps, r.wall_s);
  fmt::print("  {:8.1f} ms a step, {:.2f} s of wall time a simulated second\n", 1e3 * r.wall_s / r.steps,
             r.wall_s / r.simulated_s);
  if (r.iterations_a_step > 0) fmt::print("  {:8.1f} iterations a step\n", r.iterations_a_step);
  fmt::print("  {:8.0f} bytes a particle\n", bytes / (fluid + static_cast<double>(solver.solid_count())));
  for (const auto& [phase, phase_s] : r.phases) fmt::print("  {:6.1f} %  {}\n", 100 * phase_s / r.wall_s, phase);
  fmt::print("  {:6.1f} %  sensors\n\n", 100 * sensors_s / r.wall_s);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times whole steps of a solver in violent flow"};
  std::string case_name = "kleefsman";
  std::vector<double> distances_m{0.02};
  std::vector<int> threads{1, 2};
  std::string solver = "wcsph";
  std::vector<std::string> walls;
  std::vector<std::string> overrides;
  Stretch stretch;
  app.add_option("--case", case_name, "Case")->capture_default_str();
  app.add_option("--l0", distances_m, "Particle distances [m]")->capture_default_str();
  app.add_option("--threads", threads, "Numbers of threads")->capture_default_str();
  app.add_option("--solver", solver, "Solver")->capture_default_str();
  app.add_option("--walls", walls, "Wall models (default: all of the solver)");
  app.add_option("--set", overrides, "key=value: parameters of the solver");
  app.add_option("--from", stretch.from_s, "Begin of the timed stretch [s]")->capture_default_str();
  app.add_option("--to", stretch.to_s, "End of the timed stretch [s]")->capture_default_str();
  app.add_option(
         "--jitter", stretch.jitter,
         "Displace the fluid at the start by up to this many particle distances, to time disorder from --from 0")
      ->check(CLI::Range(0.0, 0.5));
  CLI11_PARSE(app, argc, argv);
  try {
    const Case c = load_case(case_name);
    if (const SolverOption* option = c.find_solver(solver); walls.empty() && option != nullptr)
      for (const WallOption& wall_model : option->walls) walls.push_back(wall_model.name);
    for (const double l0_m : distances_m) {
      for (const std::string& wall_model : walls) {
        for (const int n : threads) {
          RunRequest request;
          request.solver = solver;
          request.walls = wall_model;
          for (const std::string& text : overrides) request.overrides.push_back(parse_override(text));
          request.l0_m = l0_m;
          request.threads = n;
          measure(c, resolve_settings(c, request), stretch);
        }
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_rate: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
