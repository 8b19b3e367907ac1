#include "validation/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "validation/available_memory.h"
#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/plan.h"
#include "validation/progress.h"
#include "validation/rate_probe.h"
#include "validation/solver_factory.h"

namespace sluice::cli {
namespace {

struct RunArguments {
  std::string case_name;
  RunRequest request;
  double l0_m = 0;
  double alpha = 0;
  std::vector<std::string> overrides;
  std::string out;
  bool dry_run = false;
  bool force = false;
  bool log_steps = false;
  double checkpoint_every_s = RunOptions().checkpoint_every_s;
};

const char* const run_footer =
    "key=value overrides a parameter: t_end_s, output_rate_Hz, or one of the solver's (alpha, delta, courant,\n"
    "speed_of_sound_m_s, ...; an unknown key lists them).\n"
    "Ctrl-C ends a run cleanly and keeps what was computed; a second one ends it at once. `sluice resume DIR` goes "
    "on.\n\n"
    "Examples:\n"
    "  sluice run kleefsman --solver wcsph --l0 0.02 --alpha 0.01\n"
    "  sluice run kleefsman --l0 0.03 --walls dynamic --snapshots --out runs/dynamic\n"
    "  sluice run kleefsman --l0 0.02 t_end_s=0.1 delta=0.05 --threads 1\n"
    "  sluice run kleefsman --l0 0.0075 --dry-run";

RunSettings settings_of(const Case& c, const CLI::App& command, RunArguments& arguments) {
  RunRequest& request = arguments.request;
  try {
    if (command.count("--l0") > 0) request.l0_m = arguments.l0_m;
    if (command.count("--alpha") > 0) request.overrides.emplace_back("alpha", arguments.alpha);
    for (const std::string& text : arguments.overrides) request.overrides.push_back(parse_override(text));
    return resolve_settings(c, request);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

int run(const CLI::App& command, RunArguments& arguments) {
  const Case c = load_case(arguments.case_name);
  const RunSettings settings = settings_of(c, command, arguments);
  RunOptions options;
  options.out = arguments.out.empty() ? default_run_directory(c, settings) : std::filesystem::path(arguments.out);
  options.force = arguments.force;
  options.checkpoint_every_s = arguments.checkpoint_every_s;
  options.log_steps = arguments.log_steps;
  options.plan = probed_plan(c, settings, options.out);
  if (arguments.dry_run) {
    fmt::print("{}into {}\n", describe(*options.plan, available_memory_bytes()), options.out.string());
    refuse_if_too_large(c, settings, *options.plan, available_memory_bytes());
    return 0;
  }
  options.progress = stderr;
  options.terminal = isatty(STDERR_FILENO) == 1;
  const RunOutcome outcome = run_case(c, settings, options);
  if (!outcome.error.empty())
    throw std::runtime_error(outcome.error + " (see " + (options.out / "log.txt").string() + ")");
  tell(stderr, fmt::format("{}; results in {}\n", outcome.status, options.out.string()));
  return outcome.exit_code;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Run a case into a run directory");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("CASE", arguments->case_name, "Name of a case (see `sluice list`) or path of a case file")
      ->required();
  command->add_option("OVERRIDES", arguments->overrides, "key=value ...");
  command->add_option("--solver", arguments->request.solver, "Solver (default: the case's first)");
  command->add_option("--walls", arguments->request.walls, "Wall model (default: the solver's default in the case)");
  command->add_option("--l0", arguments->l0_m, "Particle distance [m] (default: the case's tier `standard`)");
  command->add_option("--alpha", arguments->alpha, "Artificial viscosity, the same as alpha=...");
  command
      ->add_option("--threads", arguments->request.threads, "Threads (default: OMP_NUM_THREADS, else all processors)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--out", arguments->out, "Run directory (default: runs/<case>-<solver>-<walls>-l0...-alpha...)");
  command->add_flag("--snapshots", arguments->request.snapshots, "Write ParaView snapshots at the case's times");
  command->add_option("--snapshot-every", arguments->request.snapshot_every_s, "Write snapshots at this interval [s]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--checkpoint-every", arguments->checkpoint_every_s,
                   "Seconds between checkpoints; 0: only when interrupted")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--log-steps", arguments->log_steps,
                    "A line in log.txt for every step; with MPS, the residuals of its pressure equation");
  command->add_flag("--dry-run", arguments->dry_run, "Print particles, memory and expected time, and stop");
  command->add_flag("--force", arguments->force, "Replace a run that stands in the directory already");
  command->footer(run_footer);
  command->callback([command, arguments, &exit_code] { exit_code = run(*command, *arguments); });
}

}  // namespace sluice::cli
