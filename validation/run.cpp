#include "validation/run.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <utility>

#include "validation/available_memory.h"
#include "validation/checkpoint.h"
#include "validation/interrupt.h"
#include "validation/manifest.h"
#include "validation/plan.h"
#include "validation/progress.h"
#include "validation/run_cost.h"
#include "validation/run_lock.h"
#include "validation/run_loop.h"
#include "validation/run_manifest.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Solver> solver_for(const Case& c, const Scene& scene, const RunSettings& settings,
                                   const SolverFactory& factory) {
  return factory ? factory(c, scene, settings) : make_solver(c, scene, settings);
}

// The scene goes when the solver stands: at fine resolutions it is worth a fifth of the solver's memory.
std::unique_ptr<RunLoop> begin(const Case& c, const RunSettings& settings, const RunOptions& options, RunLog& log,
                               const std::optional<RunPoint>& point) {
  const RunStart start = RunStart::now();
  const Scene scene = build_scene(scene_description(c, settings));
  auto solver = solver_for(c, scene, settings, options.factory);
  if (point) restore_checkpoint(options.out / checkpoint_file, *solver);
  return std::make_unique<RunLoop>(RunParts{c, settings, options, scene, std::move(solver), log}, start, point);
}

void say(const RunOptions& options, RunLog& log, const std::string& text) {
  if (options.progress != nullptr) tell(options.progress, text);
  log.line(text);
}

void say_if_unlocked(const RunOptions& options, RunLog& log, const RunLock& lock) {
  if (lock.held()) return;
  say(options, log,
      "warning: the file system of the run's directory knows no locks; see to it that no second program computes "
      "there\n");
}

// Nothing has been computed yet; the directory still says what happened.
RunOutcome failed_at_start(const Case& c, const RunSettings& settings, const RunOptions& options, RunLog& log,
                           const std::string& error) {
  nlohmann::json manifest = asked_manifest(c, settings);
  manifest["status"] = "failed";
  manifest["error"] = error;
  write_manifest(options.out, manifest);
  log.line("failed: " + error);
  return {"failed", error, 1, false, InterruptGuard::signal()};
}

std::string what_runs(const Case& c, const RunSettings& settings, const fs::path& out) {
  return fmt::format("{}: {} with {} walls, l0 = {:g} m, to t = {:g} s on {} threads, into {}\n", c.name,
                     settings.solver, settings.walls, settings.l0_m, settings.t_end_s, settings.threads, out.string());
}

RunHeader header_of(const fs::path& directory) {
  const fs::path file = directory / checkpoint_file;
  if (!fs::exists(file) && fs::exists(directory / "run.json"))
    throw std::runtime_error(fmt::format(
        "{}: holds no checkpoint: the run has finished, and there is nothing to do, or it was stopped before "
        "its first one (then start it anew with `sluice run ... --force`)",
        directory.string()));
  const nlohmann::json json = read_checkpoint_header(file);
  try {
    return run_header_from(json);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: its header lacks something: {} (start the run anew with `sluice run ... "
                    "--force`)",
                    file.string(), error.what()));
  }
}

/// Parameters that this program has and an older one had not: what it did without them is not known here.
void refuse_missing_parameters(const fs::path& directory, const RunHeader& header) {
  for (const std::string& name : solver_parameter_names(header.settings.solver))
    if (!header.settings.parameters.contains(name))
      throw std::runtime_error(fmt::format(
          "{}: was written by an older program ({}), whose {} had no parameter {}; go on with that program, "
          "or start the run anew with `sluice run ... --force`",
          (directory / checkpoint_file).string(), header.commit, header.settings.solver, name));
}

Case load_case_of(const fs::path& directory, const RunHeader& header) {
  try {
    return load_case(header.case_file);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{} (where it is now: `sluice resume {} --case FILE`)", error.what(), directory.string()));
  }
}

void refuse_changed_case(const Case& c, const RunHeader& header) {
  if (has_inputs_of(c, header.computed_hash, header.case_hash)) return;
  throw std::runtime_error(fmt::format(
      "{}: has changed {}since the run was begun; put the old file back, or start the run anew with `sluice "
      "run ... --force`",
      c.file.string(), header.computed_hash.empty() ? "" : "in what is computed "));
}

}  // namespace

RunOutcome run_case(const Case& c, const RunSettings& settings, const RunOptions& options) {
  const Plan plan = options.plan ? *options.plan : plan_near(c, settings, options.out);
  const auto available = options.available_memory_bytes ? options.available_memory_bytes : available_memory_bytes();
  refuse_if_too_large(c, settings, plan, available);
  const RunLock lock = prepare_run_directory(options.out, options.force);
  RunLog log(options.out / "log.txt");
  say_if_unlocked(options, log, lock);
  say(options, log, what_runs(c, settings, options.out));
  say(options, log, describe(plan, available));
  const InterruptGuard guard;
  std::unique_ptr<RunLoop> run;
  try {
    run = begin(c, settings, options, log, std::nullopt);
  } catch (const std::exception& error) {
    return failed_at_start(c, settings, options, log, error.what());
  }
  return run->execute();
}

RunOutcome resume_run(const fs::path& directory, const ResumeOptions& options) {
  header_of(directory);  // what holds no run is refused before a lock is put there
  const RunLock lock(directory);
  RunHeader header = header_of(directory);
  const Case c = options.the_case ? *options.the_case : load_case_of(directory, header);
  refuse_changed_case(c, header);
  refuse_missing_parameters(directory, header);
  if (options.threads > 0) header.settings.threads = options.threads;
  RunOptions run_options;
  run_options.out = directory;
  run_options.progress = options.progress;
  run_options.terminal = options.terminal;
  run_options.checkpoint_every_s = options.checkpoint_every_s;
  run_options.factory = options.factory;
  refuse_if_too_large(c, header.settings, plan_run(c, header.settings),
                      options.available_memory_bytes ? options.available_memory_bytes : available_memory_bytes(), true);
  RunLog log(directory / "log.txt", true);
  say_if_unlocked(run_options, log, lock);
  const InterruptGuard guard;
  const auto run = begin(c, header.settings, run_options, log, header.point);
  say(run_options, log, "resumed: " + what_runs(c, header.settings, directory));
  if (header.commit != build_info().commit)
    say(run_options, log,
        fmt::format("warning: begun by another build ({}; this is {}): the results may differ from those of either\n",
                    header.commit, build_info().commit));
  return run->execute();
}

}  // namespace sluice
