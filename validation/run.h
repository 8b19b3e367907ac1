// Runs one case with one solver into a run directory.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "solvers/solver.h"
#include "validation/case.h"
#include "validation/run_settings.h"

namespace sluice {

using SolverFactory = std::function<std::unique_ptr<Solver>(const Case&, const Scene&, const RunSettings&)>;

struct RunOptions {
  std::filesystem::path out;
  bool force = false;                                  ///< replace a finished run that stands in `out`
  std::FILE* progress = nullptr;                       ///< plan and progress go here; nullptr: nowhere
  bool log_steps = false;                              ///< log.txt has a line for every step
  bool terminal = false;                               ///< `progress` is a terminal
  SolverFactory factory;                               ///< empty: make_solver()
  std::optional<std::int64_t> available_memory_bytes;  ///< none: ask the system
};

struct RunOutcome {
  std::string status;  ///< "finished", "interrupted" or "failed", as in run.json
  std::string error;   ///< of a failed run
  int exit_code = 0;   ///< 0; 1 failed; 128 + signal when interrupted
};

/// Builds the scene and the solver, steps to the end, samples the sensors, and writes run.json, probes.csv, log.txt and
/// the snapshots asked for. A run that fails or is interrupted keeps what it computed, and run.json says so.
/// Throws std::runtime_error when the run is refused before anything is written: not enough memory, or a directory that
/// holds a run already (the message names the remedy).
RunOutcome run_case(const Case& c, const RunSettings& settings, const RunOptions& options);

}  // namespace sluice
