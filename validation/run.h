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
#include "validation/plan.h"
#include "validation/run_settings.h"

namespace sluice {

using SolverFactory = std::function<std::unique_ptr<Solver>(const Case&, const Scene&, const RunSettings&)>;

struct RunOptions {
  std::filesystem::path out;
  bool force = false;                                  ///< replace what stands in `out`, results and all
  std::FILE* progress = nullptr;                       ///< plan and progress go here; nullptr: nowhere
  double checkpoint_every_s = 600;                     ///< wall time; 0: only when the run is interrupted
  bool log_steps = false;                              ///< log.txt has a line for every step
  bool terminal = false;                               ///< `progress` is a terminal
  SolverFactory factory;                               ///< empty: make_solver()
  std::optional<std::int64_t> available_memory_bytes;  ///< none: ask the system
  std::optional<Plan> plan;                            ///< none: plan_near()
};

/// Choices for going on with a run; all else stands in its checkpoint.
struct ResumeOptions {
  std::optional<Case> the_case;  ///< none: read from where it was when the run began; its inputs must not have changed
  int threads = 0;               ///< 0: as many as before
  std::FILE* progress = nullptr;
  bool terminal = false;
  double checkpoint_every_s = 600;
  SolverFactory factory;
  std::optional<std::int64_t> available_memory_bytes;
};

struct RunOutcome {
  std::string status;     ///< "finished", "interrupted" or "failed", as in run.json
  std::string error;      ///< of a failed run, or of one that was interrupted and could not write its checkpoint
  int exit_code = 0;      ///< 0; 1 where there is an error; 128 + signal when interrupted
  bool advanced = false;  ///< made a time step, from where it began or was resumed
  int signal = 0;         ///< SIGINT or SIGTERM where one came, though the run may have ended by itself; else 0

  /// The exit code of a program that was told to stop meanwhile, whatever came of the run; 0 where it was not.
  int stop_code() const { return signal == 0 ? 0 : exit_code != 0 ? exit_code : 128 + signal; }
};

/// Builds the scene and the solver, steps to the end, samples the sensors, and writes run.json, probes.csv, log.txt and
/// the snapshots asked for. A run that fails or is interrupted keeps what it computed, and run.json says so.
/// Throws std::runtime_error when the run is refused before anything is written: not enough memory, a directory that
/// holds a run already, or one in which another program computes (the message names the remedy).
RunOutcome run_case(const Case& c, const RunSettings& settings, const RunOptions& options);

/// Goes on with a run from its checkpoint, as if it had never stopped: probes.csv, snapshots and manifest come out as
/// those of a run in one go, bit for bit where they hold results. Throws std::runtime_error when there is nothing to go
/// on with, the checkpoint cannot be read, or the case's inputs have changed since; nothing is then touched.
RunOutcome resume_run(const std::filesystem::path& directory, const ResumeOptions& options);

}  // namespace sluice
