#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/report.h"
#include "validation/acceptance.h"
#include "validation/begin_anew.h"
#include "validation/campaign.h"
#include "validation/checkpoint.h"
#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/legs.h"
#include "validation/manifest.h"
#include "validation/progress.h"
#include "validation/run.h"
#include "validation/solver_factory.h"
#include "validation/suggest.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
  std::string case_name = "kleefsman";
  std::string solver;
  std::string tier = "quick";
  std::string out = "reports/out";
  std::string runs = "runs";
  int threads = 0;
  bool reuse = false;
};

const char* const validate_footer =
    "Runs the case at the tier with every solver that this program has, and every wall model: those with acceptance\n"
    "rows are judged, the others stand beside them in the report. Runs land in runs/validate-TIER-...; exit code 1 "
    "when a band is missed. What is computed anew there is first moved to runs/outdated.\n\n"
    "Examples:\n"
    "  sluice validate --tier quick\n"
    "  sluice validate --tier standard --threads 2 --out reports/standard";

const Tier& find_tier(const Case& c, const std::string& name) {
  if (const Tier* tier = c.find_tier(name)) return *tier;
  std::vector<std::string> names;
  for (const Tier& tier : c.tiers) names.push_back(tier.name);
  throw UsageError(fmt::format("--tier: case {} has no tier `{}`{}", c.name, name, suggestion(name, names)));
}

const SolverOption& find_solver(const Case& c, const std::string& name) {
  if (const SolverOption* solver = c.find_solver(name)) return *solver;
  std::vector<std::string> names;
  for (const SolverOption& solver : c.solvers) names.push_back(solver.name);
  throw UsageError(fmt::format("--solver: case {} has no solver `{}`{}", c.name, name, suggestion(name, names)));
}

/// Whether it is sure that this very build computed a run.
bool is_of_this_build(const RunRecord& record) {
  const std::string commit = record.text("commit").value_or("");
  return commit == build_info().commit && names_one_build(commit);
}

RunOutcome go_on(const CampaignRun& run, const Case& c) {
  ResumeOptions options;
  options.the_case = c;
  options.threads = run.settings.threads;
  options.progress = stderr;
  options.terminal = isatty(STDERR_FILENO) == 1;
  return resume_run(run.directory, options);
}

/// Keeps a finished run (where asked to) or goes on with an unfinished one, where it is of this very build, case and
/// settings; else begins. Throws where the run is refused.
RunOutcome run_once(const Case& c, const ValidateArguments& arguments, const RunRequest& request,
                    const fs::path& directory) {
  const Campaign alone{"validate", {c}, {{0, resolve_settings(c, request), directory}}, {}};
  const CampaignRun& run = alone.runs.front();
  const CampaignState state = state_of(alone, run);
  if (state == CampaignState::finished && arguments.reuse && has_rows(directory)) {
    const RunRecord record = read_run(directory);
    if (is_of_this_build(record) && difference_of_legs(record.manifest).empty()) {
      tell(stderr, fmt::format("{}: reused\n", directory.string()));
      return {"finished", "", 0};
    }
  }
  if (state == CampaignState::resumable && is_of_this_build(read_run(directory))) return go_on(run, c);
  RunOptions options;
  options.progress = stderr;
  options.terminal = isatty(STDERR_FILENO) == 1;
  return begin_anew(alone, run, options);
}

// The default wall model first: if time runs out, it is what counts.
std::vector<std::string> walls_in_order(const SolverOption& solver) {
  std::vector<std::string> names{solver.default_walls};
  for (const WallOption& walls : solver.walls)
    if (walls.name != solver.default_walls) names.push_back(walls.name);
  return names;
}

bool print_acceptance(const Case& c, const std::vector<fs::path>& directories) {
  const Measurements measured = Measurements::load(c);
  for (const std::string& problem : measured.problems())
    tell(stderr, fmt::format("sluice: warning: no measurement: {}\n", problem));
  bool passed = true;
  bool judged = false;
  for (const fs::path& directory : directories) {
    const RunRecord record = read_run(directory);
    const auto checks = check_acceptance(c, record, measured);
    const bool applicable = std::any_of(checks.begin(), checks.end(), [](const AcceptanceCheck& check) {
      return check.verdict != AcceptanceVerdict::not_applicable;
    });
    if (!applicable) {
      tell(stdout,
           fmt::format("{}: {}: no acceptance rows, for comparison only\n", directory.string(), record.label()));
      continue;
    }
    judged = true;
    tell(stdout, fmt::format("{}: {}\n{}{}\n", directory.string(), record.label(), acceptance_table(checks),
                             verdict_text(checks)));
    passed = passed && all_passed(checks);
  }
  if (!judged) tell(stdout, "no acceptance row applies to any of these runs\n");
  return passed && judged;
}

std::vector<RunRequest> requests(const Case& c, const ValidateArguments& arguments, const Tier& tier) {
  std::vector<RunRequest> all;
  for (const SolverOption& solver : c.solvers) {
    if (!arguments.solver.empty() && solver.name != arguments.solver) continue;
    if (arguments.solver.empty() && !has_solver(solver.name))
      continue;  // another code's, with acceptance rows of its own
    for (const std::string& walls : walls_in_order(solver)) {
      RunRequest request;
      request.solver = solver.name;
      request.walls = walls;
      request.l0_m = tier.l0_m;
      request.threads = arguments.threads;
      request.snapshots = walls == solver.default_walls;
      request.overrides = {{"t_end_s", tier.t_end_s}};
      all.push_back(request);
    }
  }
  return all;
}

struct Computed {
  std::vector<fs::path> directories;  ///< of runs that can be judged and reported
  bool any_failed = false;
  int interrupted = 0;      ///< exit code, or 0
  fs::path interrupted_in;  ///< the directory of the run that it met
};

// One run that is refused (a solver's memory, say) does not keep the others from their verdict.
Computed compute(const Case& c, const ValidateArguments& arguments, const Tier& tier) {
  Computed computed;
  for (const RunRequest& request : requests(c, arguments, tier)) {
    const fs::path directory = fs::path(arguments.runs) /
                               fmt::format("validate-{}-{}-{}-{}", tier.name, c.name, request.solver, request.walls);
    try {
      const RunOutcome outcome = run_once(c, arguments, request, directory);
      if (!outcome.error.empty())
        tell(stderr, fmt::format("sluice: error: {}: {}\n", directory.string(), outcome.error));
      computed.interrupted = outcome.stop_code();
      computed.interrupted_in = directory;
      if (computed.interrupted != 0 && outcome.status == "finished") computed.directories.push_back(directory);
      if (computed.interrupted != 0) return computed;
      computed.any_failed = computed.any_failed || outcome.exit_code != 0;
      if (fs::exists(directory / "probes.csv"))
        computed.directories.push_back(directory);  // else it failed at its start
    } catch (const std::exception& error) {
      computed.any_failed = true;
      tell(stderr, fmt::format("sluice: error: {}: {}\n", directory.string(), error.what()));
    }
  }
  return computed;
}

/// What the same command will do with what there is.
std::string after_interruption(const Computed& computed, bool reuse) {
  const bool sure = names_one_build(build_info().commit);
  const bool has_checkpoint = fs::exists(computed.interrupted_in / checkpoint_file);
  const bool has_ended = !computed.directories.empty() && computed.directories.back() == computed.interrupted_in;
  std::vector<std::string> deeds;
  if (!has_ended) deeds.emplace_back(sure && has_checkpoint ? "goes on with this run" : "begins this run anew");
  if (!computed.directories.empty())
    deeds.emplace_back(!sure   ? "computes finished ones anew"
                       : reuse ? "keeps finished ones"
                               : "computes finished ones anew (with --reuse it keeps them)");
  std::string text =
      fmt::format("interrupted; the same command {}; what it begins anew is first moved to {}\n",
                  fmt::join(deeds, " and "), (computed.interrupted_in.parent_path() / "outdated").string());
  if (!sure)
    text += fmt::format("(its commit, {}, does not tell what it was built from: it takes no run for its own)\n",
                        build_info().commit);
  if (!sure && has_checkpoint)
    text += fmt::format("`sluice resume {}` goes on with this run\n", computed.interrupted_in.string());
  return text;
}

int validate(const ValidateArguments& arguments) {
  const Case c = load_case(arguments.case_name);
  const Tier& tier = find_tier(c, arguments.tier);
  if (!arguments.solver.empty()) find_solver(c, arguments.solver);
  const Computed computed = compute(c, arguments, tier);
  if (computed.interrupted != 0) {
    tell(stderr, after_interruption(computed, arguments.reuse));
    return computed.interrupted;
  }
  const std::vector<fs::path>& directories = computed.directories;
  if (directories.empty())
    throw std::runtime_error(computed.any_failed ? "no run left anything to judge (why is told above)"
                                                 : "this program has none of the case's solvers");
  const bool passed = print_acceptance(c, directories);
  write_report(directories, arguments.out);
  tell(stdout, fmt::format("report: {}\n", (fs::path(arguments.out) / "index.html").string()));
  return passed && !computed.any_failed ? 0 : 1;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("validate", "Run a case at a tier, report it, and judge it by its acceptance bands");
  auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("CASE", arguments->case_name, "Case")->capture_default_str();
  command->add_option("--solver", arguments->solver, "Solver (default: all of the case that this program has)");
  command->add_option("--tier", arguments->tier, "Resolution: a tier of the case")->capture_default_str();
  command->add_option("--threads", arguments->threads, "Threads (default: OMP_NUM_THREADS, else all processors)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--out", arguments->out, "Directory of the report")->capture_default_str();
  command->add_option("--runs", arguments->runs, "Directory of the runs")->capture_default_str();
  command->add_flag("--reuse", arguments->reuse, "Keep finished runs of the same commit and inputs");
  command->footer(validate_footer);
  command->callback([arguments, &exit_code] { exit_code = validate(*arguments); });
}

}  // namespace sluice::cli
