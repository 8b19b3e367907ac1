#include "validation/run_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include "validation/checkpoint.h"
#include "validation/interrupt.h"
#include "validation/legs.h"
#include "validation/manifest.h"

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

ProbeWriter probe_writer(const std::filesystem::path& file, const SensorArray& sensors,
                         const std::optional<RunPoint>& point) {
  if (point) return {file, sensors.columns(), point->probes};
  return {file, sensors.columns()};
}

}  // namespace

RunStart RunStart::now() {
  return {Clock::now(), cpu_time_s()};
}

RunLoop::RunLoop(RunParts parts, const RunStart& start, const std::optional<RunPoint>& point)
    : start_(start),
      last_manifest_(Clock::now()),
      last_checkpoint_(Clock::now()),
      settings_(parts.settings),
      options_(parts.options),
      case_file_(std::filesystem::absolute(parts.the_case.file).string()),
      case_hash_(parts.the_case.hash),
      computed_hash_(parts.the_case.computed_hash),
      solver_(std::move(parts.solver)),
      sensors_(parts.the_case, parts.scene, solver_->smoothing_length_m(), settings_.solver, settings_.walls),
      probes_(probe_writer(options_.out / "probes.csv", sensors_, point)),
      snapshots_(options_.out, point ? point->snapshots : 0),
      progress_(options_.progress, options_.terminal, settings_.t_end_s),
      log_(parts.log),
      manifest_(start_manifest(parts.the_case, settings_, parts.scene, sensors_.placed())) {
  for (const auto& warning : manifest_["warnings"]) log_.line("warning: " + warning.get<std::string>());
  if (point) {
    tally_ = point->tally;
    earlier_wall_s_ = tally_.wall_s;
    earlier_cpu_s_ = tally_.cpu_s;
    next_sample_ = point->next_sample;
    next_snapshot_ = point->next_snapshot;
    resumed_ = point->resumed + 1;
    manifest_["started"] = point->started;
    manifest_["legs"] = point->legs;
    for (const auto& warning : point->warnings) add_warning(warning);
  }
  manifest_["resumed"] = resumed_;
  manifest_["legs"].push_back(leg_of(manifest_, solver_->time_s()));
  if (const std::string text = difference_of_legs(manifest_); !text.empty()) add_warning(text);
  refresh_manifest();
}

RunOutcome RunLoop::execute() {
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
  outcome.advanced = dt_s_ > 0;
  outcome.signal = InterruptGuard::signal();
  return outcome;
}

void RunLoop::advance() {
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
  if (options_.log_steps) log_.line(step_text());
  sample_if_due();
  if (const std::string text = progress_.update(state()); !text.empty()) log_.line(text);
  if (seconds_since(last_manifest_) > manifest_interval_s) unless_disk_fails([&] { refresh_manifest(); });
  if (options_.checkpoint_every_s > 0 && seconds_since(last_checkpoint_) > options_.checkpoint_every_s)
    save_checkpoint();
}

// The first step at or after each multiple of the sampling interval. Half a microsecond absorbs rounding.
void RunLoop::sample_if_due() {
  const double now_s = solver_->time_s() + 5e-7;
  if (now_s * settings_.output_rate_Hz >= static_cast<double>(next_sample_)) {
    const Stopwatch watch(tally_.sensors_s);
    sensors_.sample(*solver_, values_);
    probes_.append(solver_->time_s(), values_);
    if (!probes_.trouble().empty()) warn(probes_.trouble() + "; rows wait in memory");
    next_sample_ = static_cast<std::int64_t>(std::floor(now_s * settings_.output_rate_Hz)) + 1;
  }
  bool due = false;
  for (; next_snapshot_ < settings_.snapshot_times_s.size() && settings_.snapshot_times_s[next_snapshot_] <= now_s;
       ++next_snapshot_)
    due = true;
  if (due) unless_disk_fails([&] { write_snapshot(); });
}

// What a full disk keeps from being written now may be written later, or be done without: no reason to stop.
template <class Output>
void RunLoop::unless_disk_fails(Output&& output) {
  try {
    output();
  } catch (const std::exception& error) {
    warn(error.what());
  }
}

void RunLoop::write_snapshot() {
  const Stopwatch watch(tally_.output_s);
  const auto file = snapshots_.write(solver_->snapshot());
  log_.line(fmt::format("snapshot at t = {:.4f} s: {}", solver_->time_s(), file.filename().string()));
}

RunOutcome RunLoop::ending() {
  if (solver_->time_s() >= settings_.t_end_s) return {"finished", "", 0};
  const int signal = InterruptGuard::signal();
  const std::string problem = save_checkpoint();
  if (problem.empty()) return {"interrupted", "", 128 + signal};
  return {"interrupted", fmt::format("stopped by signal {} without a checkpoint of where it was: {}", signal, problem),
          1};
}

// Every part may fail on a full disk; the first failure is the one to tell.
void RunLoop::close(RunOutcome& outcome) {
  const auto keep_first_error = [&](auto&& action) {
    try {
      action();
    } catch (const std::exception& error) {
      if (outcome.status != "failed") outcome = {"failed", error.what(), 1};
    }
  };
  keep_first_error([&] {
    probes_.flush_to_disk();
    probes_.close();
  });
  keep_first_error([&] {
    bring_up_to_date();
    manifest_["status"] = outcome.status;
    manifest_["error"] = outcome.error;
    write_manifest(options_.out, manifest_);
    // A run that has ended needs no checkpoint; until run.json says so it does.
    std::error_code ignored;
    if (outcome.status == "finished") std::filesystem::remove(options_.out / checkpoint_file, ignored);
  });
  keep_first_error([&] {
    log_.line(progress_text(state(), settings_.t_end_s));
    log_.line(outcome.error.empty() ? outcome.status : outcome.status + ": " + outcome.error);
  });
}

void RunLoop::bring_up_to_date() {
  tally_.wall_s = earlier_wall_s_ + seconds_since(start_.wall);
  tally_.cpu_s = earlier_cpu_s_ + cpu_time_s() - start_.cpu_s;
  update_manifest(manifest_, *solver_, tally_);
}

void RunLoop::refresh_manifest() {
  const Stopwatch watch(tally_.output_s);
  last_manifest_ = Clock::now();
  bring_up_to_date();
  write_manifest(options_.out, manifest_);
}

// A checkpoint that cannot be written is no reason to stop: the one before is still there. What a checkpoint counts on
// must be on the disk before it. Returns what went wrong, or "".
std::string RunLoop::save_checkpoint() {
  const Stopwatch watch(tally_.output_s);
  last_checkpoint_ = Clock::now();
  try {
    probes_.flush_to_disk();
    bring_up_to_date();
    RunPoint point{tally_,
                   probes_.position(),
                   next_sample_,
                   next_snapshot_,
                   snapshots_.count(),
                   resumed_,
                   manifest_.at("started").get<std::string>(),
                   manifest_.at("legs"),
                   manifest_.at("warnings")};
    point.tally.earlier_phases.clear();
    for (const auto& [phase, time_s] : manifest_.at("phases").items())
      if (phase != "sensors" && phase != "output") point.tally.earlier_phases[phase] = time_s;
    write_checkpoint(
        options_.out / checkpoint_file,
        to_json({settings_, case_file_, case_hash_, computed_hash_, build_info().commit, std::move(point)}), *solver_);
    log_.line(fmt::format("checkpoint at t = {:.6f} s, step {}", solver_->time_s(), solver_->steps()));
    return "";
  } catch (const std::exception& error) {
    warn(fmt::format("no checkpoint at t = {:.4f} s: {}", solver_->time_s(), error.what()));
    return error.what();
  }
}

// Kept once, however often a run goes on. Returns whether it is new.
bool RunLoop::add_warning(const std::string& text) {
  auto& warnings = manifest_["warnings"];
  if (std::find(warnings.begin(), warnings.end(), text) != warnings.end()) return false;
  warnings.push_back(text);
  return true;
}

void RunLoop::warn(const std::string& text) {
  if (!add_warning(text)) return;
  log_.line("warning: " + text);
  if (options_.progress != nullptr) tell(options_.progress, "warning: " + text + "\n");
}

// The particles as a failed step left them, so that the failure can be looked into.
void RunLoop::keep_state() {
  try {
    write_snapshot();
  } catch (const std::exception& error) {
    log_.line(fmt::format("the state could not be saved: {}", error.what()));
  }
}

std::string RunLoop::step_text() const {
  const std::string note = solver_->step_note();
  return fmt::format("step {}, t = {:.6f} s, dt = {:.3e} s{}{}", solver_->steps(), solver_->time_s(), dt_s_,
                     note.empty() ? "" : ", ", note);
}

RunState RunLoop::state() const {
  return {solver_->time_s(), solver_->steps(), dt_s_, tally_.particle_steps, tally_.stepping_s + tally_.sensors_s};
}

}  // namespace sluice
