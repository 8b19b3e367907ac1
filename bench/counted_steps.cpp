// A small fixed workload for counting instructions: a few steps of one solver on one thread, the same in every run.
// bench/instructions runs it under callgrind, which counts inside counted_steps() only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/prepared_run.h"

namespace sluice::bench {

/// Never inlined: callgrind knows it by its name.
[[gnu::noinline]] void counted_steps(Solver& solver, int steps) {
  for (int k = 0; k < steps; ++k) solver.step();
}

}  // namespace sluice::bench

int main(int argc, char** argv) {
  CLI::App app{"A few steps of one solver, for counting instructions"};
  std::string solver;
  std::string walls;
  double particles = 5000;
  int steps = 10;
  bool provenance = false;
  app.add_option("SOLVER", solver, "wcsph or mps");
  app.add_option("WALLS", walls, "Wall model");
  app.add_option("--particles", particles, "Fluid particles")->check(CLI::Range(5e3, 1e7))->capture_default_str();
  app.add_option("--steps", steps, "Steps")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_flag("--provenance", provenance, "Only print machine, commit, compiler and flags, as JSON");
  CLI11_PARSE(app, argc, argv);
  try {
    if (provenance) {
      fmt::print("{}\n", nlohmann::json(sluice::bench::provenance()).dump());
      return 0;
    }
    const sluice::bench::PreparedRun run = sluice::bench::prepare(solver, walls, particles, 1);
    sluice::bench::counted_steps(*run.solver, steps);
    fmt::print("{} {}\n", run.solver->fluid_count(), run.solver->steps());
  } catch (const std::exception& error) {
    fmt::print(stderr, "counted_steps: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
