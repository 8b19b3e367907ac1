#include "validation/run.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <vector>

#include "solvers/snapshot.h"
#include "validation/interrupt.h"
#include "validation/manifest.h"
#include "validation/plan.h"
#include "validation/progress.h"
#include "validation/run_log.h"
#include "validation/run_manifest.h"
#include "validation/sensors.h"
#include "validation/series.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

using Clock = std::chrono::steady_clock;

// How often run.json is refreshed while a run goes on.
constexpr double manifest_interval_s = 5;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Adds the time of its own life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum_s) : sum_s_(sum_s) {}
  ~Stopwatch() { sum_s_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_s_;
  Clock::time_point start_ = Clock::now();
};

// Taken before the scene is built, so that a run's time includes that.
struct RunStart {
  Clock::time_point wall = Clock::now();
  double cpu_s = cpu_time_s();
};

// Writes run.json, and says on the way how a run ended.
void finish_manifest(nlohmann::json& manifest, const std::filesystem::path& out, const RunOutcome& outcome) {
  manifest["status"] = outcome.status;
  manifest["error"] = outcome.error;
  write_manifest(out, manifest);
}

class Run {
 public:
  Run(const Case& c, const RunSettings& settings, const RunOptions& options, const Scene& scene,
      std::unique_ptr<Solver> solver, RunLog& log, const RunStart& start)
      : start_(start),
        settings_(settings),
        out_(options.out),
        solver_(std::move(solver)),
        sensors_(c, scene, solver_->smoothing_length_m(), settings.solver, settings.walls),
        probes_(options.out / "probes.csv", sensors_.columns()),
        snapshots_(options.out),
        progress_(options.progress, options.terminal, settings.t_end_s),
        log_(log),
        log_steps_(options.log_steps),
        manifest_(start_manifest(c, settings, scene, sensors_.placed())) {
    for (const auto& warning : manifest_["warnings"]) log_.line("warning: " + warning.get<std::string>());
    refresh_manifest();
  }

  // Steps to the end or to an interruption; what goes wrong ends the run as failed, with all that was computed kept.
  RunOutcome execute() {
    RunOutcome outcome;
    try {
      sample_if_due();
      while (solver_->time_s() < settings_.t_end_s && InterruptGuard::signal() == 0) advance();
      outcome = ending();
    } catch (const std::exception& error) {
      outcome = {"failed", error.what(), 1};
      log_.line(step_text());
      keep_state();
    }
    progress_.finish(state());
    close(outcome);
    return outcome;
  }

 private:
  void advance() {
    double dt_s = 0;
    {
      const Stopwatch watch(tally_.stepping_s);
      dt_s = solver_->step();
    }
    if (!(dt_s > 0) || !std::isfinite(dt_s) || !std::isfinite(solver_->time_s()))
      throw std::runtime_error(
          fmt::format("the time step became {} s at t = {} s: the solution is no longer finite (try a smaller courant "
                      "or a larger alpha)",
                      dt_s, solver_->time_s()));
    dt_s_ = dt_s;
    tally_.dt_min_s = std::min(tally_.dt_min_s, dt_s);
    tally_.dt_max_s = std::max(tally_.dt_max_s, dt_s);
    tally_.particle_steps += static_cast<double>(solver_->fluid_count());
    if (log_steps_) log_.line(step_text());
    sample_if_due();
    if (const std::string text = progress_.update(state()); !text.empty()) log_.line(text);
    if (seconds_since(last_manifest_) > manifest_interval_s) refresh_manifest();
  }

  // The first step at or after each multiple of the sampling interval. Half a microsecond absorbs rounding.
  void sample_if_due() {
    const double now_s = solver_->time_s() + 5e-7;
    if (now_s * settings_.output_rate_Hz >= static_cast<double>(next_sample_)) {
      const Stopwatch watch(tally_.sensors_s);
      sensors_.sample(*solver_, values_);
      probes_.append(solver_->time_s(), values_);
      next_sample_ = static_cast<std::int64_t>(std::floor(now_s * settings_.output_rate_Hz)) + 1;
    }
    bool due = false;
    for (; next_snapshot_ < settings_.snapshot_times_s.size() && settings_.snapshot_times_s[next_snapshot_] <= now_s;
         ++next_snapshot_)
      due = true;
    if (!due) return;
    write_snapshot();
  }

  void write_snapshot() {
    const Stopwatch watch(tally_.output_s);
    const auto file = snapshots_.write(solver_->snapshot());
    log_.line(fmt::format("snapshot at t = {:.4f} s: {}", solver_->time_s(), file.filename().string()));
  }

  // The particles as a failed step left them, so that the failure can be looked into.
  void keep_state() {
    try {
      write_snapshot();
    } catch (const std::exception& error) {
      log_.line(fmt::format("the state could not be saved: {}", error.what()));
    }
  }

  std::string step_text() const {
    const std::string note = solver_->step_note();
    return fmt::format("step {}, t = {:.6f} s, dt = {:.3e} s{}{}", solver_->steps(), solver_->time_s(), dt_s_,
                       note.empty() ? "" : ", ", note);
  }

  RunOutcome ending() const {
    if (solver_->time_s() >= settings_.t_end_s) return {"finished", "", 0};
    return {"interrupted", "", 128 + InterruptGuard::signal()};
  }

  // Every part may fail on a full disk; the first failure is the one to tell.
  void close(RunOutcome& outcome) {
    const auto keep_first_error = [&](auto&& action) {
      try {
        action();
      } catch (const std::exception& error) {
        if (outcome.status != "failed") outcome = {"failed", error.what(), 1};
      }
    };
    keep_first_error([&] { probes_.close(); });
    keep_first_error([&] {
      bring_up_to_date();
      finish_manifest(manifest_, out_, outcome);
    });
    keep_first_error([&] {
      log_.line(progress_text(state(), settings_.t_end_s));
      log_.line(outcome.error.empty() ? outcome.status : outcome.status + ": " + outcome.error);
    });
  }

  void bring_up_to_date() {
    tally_.wall_s = seconds_since(start_.wall);
    tally_.cpu_s = cpu_time_s() - start_.cpu_s;
    update_manifest(manifest_, *solver_, tally_);
  }

  void refresh_manifest() {
    const Stopwatch watch(tally_.output_s);
    bring_up_to_date();
    write_manifest(out_, manifest_);
    last_manifest_ = Clock::now();
  }

  RunState state() const {
    return {solver_->time_s(), solver_->steps(), dt_s_, tally_.particle_steps, tally_.stepping_s + tally_.sensors_s};
  }

  RunStart start_;
  Clock::time_point last_manifest_ = Clock::now();
  const RunSettings& settings_;
  std::filesystem::path out_;
  std::unique_ptr<Solver> solver_;
  SensorArray sensors_;
  ProbeWriter probes_;
  SnapshotWriter snapshots_;
  Progress progress_;
  RunLog& log_;
  bool log_steps_;
  nlohmann::json manifest_;
  RunTally tally_;
  std::vector<double> values_;
  double dt_s_ = 0;
  std::int64_t next_sample_ = 0;
  std::size_t next_snapshot_ = 0;
};

// The scene goes when the solver stands: at fine resolutions it is worth a fifth of the solver's memory.
std::unique_ptr<Run> begin(const Case& c, const RunSettings& settings, const RunOptions& options, RunLog& log) {
  const RunStart start;
  const Scene scene = build_scene(scene_description(c, settings.l0_m, settings.wall_layers));
  const SolverFactory factory = options.factory ? options.factory : SolverFactory(make_solver);
  return std::make_unique<Run>(c, settings, options, scene, factory(c, scene, settings), log, start);
}

void say(const RunOptions& options, RunLog& log, const std::string& text) {
  if (options.progress != nullptr) {
    fmt::print(options.progress, "{}", text);
    std::fflush(options.progress);
  }
  log.line(text);
}

}  // namespace

RunOutcome run_case(const Case& c, const RunSettings& settings, const RunOptions& options) {
  const Plan plan = plan_run(c, settings);
  const auto available = options.available_memory_bytes ? options.available_memory_bytes : available_memory_bytes();
  refuse_if_too_large(c, settings, plan, available);
  prepare_run_directory(options.out, options.force);
  RunLog log(options.out / "log.txt");
  say(options, log,
      fmt::format("{}: {} with {} walls, l0 = {:g} m, to t = {:g} s on {} threads, into {}\n", c.name, settings.solver,
                  settings.walls, settings.l0_m, settings.t_end_s, settings.threads, options.out.string()));
  say(options, log, describe(plan, available));
  const InterruptGuard guard;
  try {
    return begin(c, settings, options, log)->execute();
  } catch (const std::exception& error) {
    // Nothing has been computed yet; the directory still says what happened.
    RunOutcome outcome{"failed", error.what(), 1};
    nlohmann::json manifest{{"schema", manifest_schema}, {"case", c.name},
                            {"solver", settings.solver}, {"walls", settings.walls},
                            {"l0_m", settings.l0_m},     {"commit", build_info().commit},
                            {"started", utc_now()},      {"parameters", settings.parameters}};
    finish_manifest(manifest, options.out, outcome);
    log.line("failed: " + outcome.error);
    return outcome;
  }
}

}  // namespace sluice
