// One run while it goes on: steps, samples, files, checkpoints.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "solvers/scene.h"
#include "solvers/snapshot.h"
#include "solvers/solver.h"
#include "validation/progress.h"
#include "validation/run.h"
#include "validation/run_checkpoint.h"
#include "validation/run_log.h"
#include "validation/sensors.h"
#include "validation/series.h"

namespace sluice {

/// Taken before the scene is built, so that a run's time includes that.
struct RunStart {
  std::chrono::steady_clock::time_point wall;
  double cpu_s = 0;

  static RunStart now();
};

/// What a run is made of.
struct RunParts {
  const Case& the_case;
  const RunSettings& settings;
  const RunOptions& options;
  const Scene& scene;
  std::unique_ptr<Solver> solver;
  RunLog& log;
};

class RunLoop {
 public:
  /// A new run, or (with `point`) one that goes on; the solver then stands where the point was taken.
  RunLoop(RunParts parts, const RunStart& start, const std::optional<RunPoint>& point);

  /// Steps to the end or to an interruption; what goes wrong ends the run as failed, with all that was computed kept.
  RunOutcome execute();

 private:
  void advance();
  void sample_if_due();
  void write_snapshot();
  RunOutcome ending();
  void close(RunOutcome& outcome);
  void bring_up_to_date();
  void refresh_manifest();
  std::string save_checkpoint();
  template <class Output>
  void unless_disk_fails(Output&& output);
  void warn(const std::string& text);
  bool add_warning(const std::string& text);
  void keep_state();
  std::string step_text() const;
  RunState state() const;

  RunStart start_;
  std::chrono::steady_clock::time_point last_manifest_;
  std::chrono::steady_clock::time_point last_checkpoint_;
  const RunSettings& settings_;
  const RunOptions& options_;
  std::string case_file_;
  std::string case_hash_;
  std::string computed_hash_;
  std::unique_ptr<Solver> solver_;
  SensorArray sensors_;
  ProbeWriter probes_;
  SnapshotWriter snapshots_;
  Progress progress_;
  RunLog& log_;
  nlohmann::json manifest_;
  RunTally tally_;
  double earlier_wall_s_ = 0;  ///< of a run that goes on
  double earlier_cpu_s_ = 0;
  std::vector<double> values_;
  double dt_s_ = 0;
  std::int64_t resumed_ = 0;
  std::int64_t next_sample_ = 0;
  std::size_t next_snapshot_ = 0;
};

}  // namespace sluice
