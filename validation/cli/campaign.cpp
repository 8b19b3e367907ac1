#include "validation/campaign.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/begin_anew.h"
#include "validation/cli/campaign_report.h"
#include "validation/cli/campaign_slurm.h"
#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/plan.h"
#include "validation/printable.h"
#include "validation/progress.h"
#include "validation/rate_probe.h"
#include "validation/run.h"
#include "validation/run_cost.h"
#include "validation/run_lock.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct CampaignArguments {
  std::string file;
  std::string out;
  int threads = 0;
  double checkpoint_every_s = RunOptions().checkpoint_every_s;
  bool dry_run = false;
  bool force = false;
  bool no_report = false;
  bool report_only = false;
  std::string only;
  std::string engine = "local";
  std::string partition;
  std::string time_limit;
};

/// What came of one run.
struct Result {
  std::string status;  ///< as in run.json, or "kept" for one that was there already
  std::string error;
};

/// What is known of costs before the first run: where other runs are, and what the machine's first steps told.
struct KnownCosts {
  std::vector<fs::path> others;
  std::vector<RunCost> probed;

  /// With the campaign's own runs that have finished by now.
  std::vector<RunCost> now(const Campaign& campaign) const {
    std::vector<RunCost> costs = known_costs(campaign, others);
    costs.insert(costs.end(), probed.begin(), probed.end());
    return costs;
  }
};

double remaining_s(const Campaign& campaign, std::size_t from, bool force, const std::vector<RunCost>& costs) {
  double sum = 0;
  for (std::size_t i = from; i < campaign.runs.size(); ++i)
    if (force || state_of(campaign, campaign.runs[i]) != CampaignState::finished)
      sum += estimate(campaign, campaign.runs[i], costs, force).remaining_s();
  return sum;
}

/// Returns the time that it expects for all [s].
double print_plan(const Campaign& campaign, bool force, const std::vector<RunCost>& costs) {
  std::size_t to_do = 0;
  std::int64_t most_bytes = 0;
  for (const CampaignRun& run : campaign.runs) {
    const CampaignState state = state_of(campaign, run);
    const CampaignEstimate e = estimate(campaign, run, costs, force);
    fmt::print("{:10} {:>9} fluid {:>9} solid {:>8} {:>14}{}  {}\n", to_string(state), e.plan.particles.fluid,
               e.plan.particles.solid, human_bytes(static_cast<double>(e.plan.memory_bytes)),
               state == CampaignState::finished && !force ? "" : human_time(e.remaining_s()),
               e.plan.basis == PlanBasis::run ? " " : "*", run.directory.filename().string() + reason(campaign, run));
    to_do += force || state != CampaignState::finished;
    most_bytes = std::max(most_bytes, e.plan.memory_bytes);
  }
  const double planned_s = remaining_s(campaign, 0, force, costs);
  fmt::print(
      "{}: {} runs, {} to compute, at most {} of memory, about {} (*: no run of the kind on this machine yet; by a "
      "second of its first steps or, if short, this program's constants)\n",
      campaign.name, campaign.runs.size(), to_do, human_bytes(static_cast<double>(most_bytes)), human_time(planned_s));
  std::fflush(stdout);
  return planned_s;
}

/// What cannot go on tells how to begin anew within the campaign, too.
RunOutcome resume(const fs::path& directory, const ResumeOptions& options, const CampaignArguments& arguments) {
  try {
    return resume_run(directory, options);
  } catch (const NotNow&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format(
        "{} [anew within its campaign: `sluice campaign {} --out {} --force --only {}`]", error.what(),
        shell_quoted(arguments.file), shell_quoted(directory.parent_path().string()), directory.filename().string()));
  }
}

/// Without a plan it is plan_near().
RunOutcome compute(const Campaign& campaign, const CampaignRun& run, const CampaignArguments& arguments,
                   const std::optional<Plan>& plan) {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  if (!arguments.force && state_of(campaign, run) == CampaignState::resumable) {
    ResumeOptions options;
    options.threads = run.settings.threads;
    options.progress = stderr;
    options.terminal = terminal;
    options.checkpoint_every_s = arguments.checkpoint_every_s;
    options.the_case = campaign.case_of(run);
    return resume(run.directory, options, arguments);
  }
  RunOptions options;
  options.progress = stderr;
  options.terminal = terminal;
  options.checkpoint_every_s = arguments.checkpoint_every_s;
  options.plan = plan;
  if (!arguments.force) return begin_anew(campaign, run, options);
  options.out = run.directory;
  options.force = true;
  return run_case(campaign.case_of(run), run.settings, options);
}

/// A run that fails is told and does not stop the others. Returns the code of an interruption, or 0.
int compute_all(const Campaign& campaign, const CampaignArguments& arguments, const KnownCosts& known,
                std::vector<Result>& results) {
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const CampaignRun& run = campaign.runs[i];
    if (!arguments.force && state_of(campaign, run) == CampaignState::finished) {
      results.push_back({"kept", ""});
      continue;
    }
    const std::vector<RunCost> costs = known.now(campaign);
    tell(stderr,
         fmt::format("[{}/{}] {}; {} left of the campaign\n", i + 1, campaign.runs.size(),
                     run.directory.filename().string(), human_time(remaining_s(campaign, i, arguments.force, costs))));
    const CampaignEstimate planned = estimate(campaign, run, costs, arguments.force);
    const auto begin = std::chrono::steady_clock::now();
    RunOutcome outcome;
    try {
      outcome = compute(campaign, run, arguments, planned.plan);
    } catch (const std::exception& error) {
      outcome = {"failed", error.what(), 1};
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    tell(stderr, fmt::format("[{}/{}] {} after {}, planned {}\n", i + 1, campaign.runs.size(), outcome.status,
                             human_time(taken.count()), human_time(planned.remaining_s())));
    results.push_back({outcome.status, outcome.error});
    if (const int code = outcome.stop_code(); code != 0) return code;
  }
  return 0;
}

/// True when none failed.
bool print_results(const Campaign& campaign, const std::vector<Result>& results) {
  bool all_well = true;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string& error = results[i].error;
    all_well = all_well && error.empty();
    tell(stdout, fmt::format("{:12} {}{}{}\n", results[i].status, campaign.runs[i].directory.filename().string(),
                             error.empty() ? "" : ": ", error));
  }
  return all_well;
}

/// Drops all runs but that of this name.
void keep_only(Campaign& campaign, const CampaignArguments& arguments) {
  std::erase_if(campaign.runs, [&](const CampaignRun& r) { return r.directory.filename() != arguments.only; });
  if (campaign.runs.empty())
    throw UsageError(fmt::format("--only: {} has no run {} (--dry-run lists them)", arguments.file, arguments.only));
}

/// What a task of a job array does: the campaign's one run, from wherever it stands.
int compute_only(const Campaign& campaign, const CampaignArguments& arguments) {
  const CampaignRun& run = campaign.runs.front();
  const CampaignState before = state_of(campaign, run);
  if (before == CampaignState::finished && !arguments.force) {
    fmt::print("{}: finished already\n", arguments.only);
    return 0;
  }
  const RunOutcome outcome = compute(campaign, run, arguments, std::nullopt);
  if (!outcome.error.empty()) throw std::runtime_error(fmt::format("{}: {}", arguments.only, outcome.error));
  // Who puts an interrupted run back into a queue must not do so for ever.
  if (outcome.status == "interrupted" && !outcome.advanced)
    throw std::runtime_error(
        fmt::format("{}: interrupted before it had made a single step (give it more time)", arguments.only));
  fmt::print("{}: {}\n", arguments.only, outcome.status);
  return outcome.exit_code;
}

/// Of a forced campaign: what it has not come to, and what would be taken for finished.
void tell_kept(const Campaign& campaign, std::size_t from) {
  for (std::size_t i = from; i < campaign.runs.size(); ++i)
    if (state_of(campaign, campaign.runs[i]) == CampaignState::finished)
      tell(stderr,
           fmt::format("but keeps {}, of before (anew: --force --only {})\n",
                       campaign.runs[i].directory.filename().string(), campaign.runs[i].directory.filename().string()));
}

int compute_and_report(const Campaign& campaign, const CampaignArguments& arguments, const fs::path& out,
                       const KnownCosts& known, double planned_s) {
  std::vector<Result> results;
  const auto begin = std::chrono::steady_clock::now();
  const int interrupted = compute_all(campaign, arguments, known, results);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const bool all_well = print_results(campaign, results);
  if (interrupted != 0) {
    tell(stderr, fmt::format("interrupted; the same command {}goes on\n", arguments.force ? "without --force " : ""));
    if (arguments.force) tell_kept(campaign, results.size());
    return interrupted;
  }
  tell(stdout, fmt::format("{}: {} taken, {} planned at its begin\n", campaign.name, human_time(taken.count()),
                           human_time(planned_s)));
  if (!arguments.no_report) report_cases(campaign, out);
  return all_well ? 0 : 1;
}

/// Options of the command line before the file's; plans reckon with the threads that a task will have.
void take_slurm_options(Campaign& campaign, const CampaignArguments& arguments) {
  SlurmOptions& slurm = campaign.slurm;
  if (!arguments.partition.empty()) slurm.partition = arguments.partition;
  if (!arguments.time_limit.empty()) slurm.time_limit = arguments.time_limit;
  if (arguments.threads > 0) slurm.threads = arguments.threads;
  if (const std::string problem = slurm_problem(slurm); !problem.empty()) throw UsageError(problem);
  if (arguments.force)
    throw UsageError(
        "--force: not with --engine slurm, whose tasks go on with what they find (remove the runs' folders)");
  for (CampaignRun& run : campaign.runs) run.settings.threads = slurm.threads;
}

int run_on_slurm(const Campaign& campaign, const CampaignArguments& arguments, const fs::path& out) {
  const bool report = !arguments.no_report && arguments.only.empty();
  return submit(campaign, {arguments.file, out, arguments.checkpoint_every_s, report, arguments.dry_run});
}

int run(const CampaignArguments& arguments) {
  const fs::path file = arguments.file;
  const fs::path out = arguments.out.empty() ? fs::path("runs") / file.stem() : fs::path(arguments.out);
  Campaign campaign = load_campaign(file, out, arguments.threads);
  const bool slurm = arguments.engine == "slurm";
  if (!slurm && (!arguments.partition.empty() || !arguments.time_limit.empty()))
    throw UsageError("--partition and --time-limit are for --engine slurm");
  if (arguments.report_only && !arguments.only.empty())
    throw UsageError("--report-only: not with --only (sluice report RUN... makes a report of some runs)");
  if (arguments.report_only) return report_only(campaign, out);
  if (!arguments.only.empty()) keep_only(campaign, arguments);
  if (!arguments.only.empty() && !arguments.dry_run && !slurm) return compute_only(campaign, arguments);
  if (slurm) take_slurm_options(campaign, arguments);
  if (slurm && arguments.dry_run) return run_on_slurm(campaign, arguments, out);  // prints nothing but the scripts
  KnownCosts known{runs_near(out), {}};
  std::vector<RunCost> costs = known.now(campaign);
  if (!slurm) known.probed = probe_costs(campaign, arguments.force, costs);
  costs.insert(costs.end(), known.probed.begin(), known.probed.end());
  const double planned_s = print_plan(campaign, arguments.force, costs);
  if (slurm) return run_on_slurm(campaign, arguments, out);
  return arguments.dry_run ? 0 : compute_and_report(campaign, arguments, out, known, planned_s);
}

}  // namespace

void add_campaign(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("campaign", "Compute many runs from one file, and report them");
  auto arguments = std::make_shared<CampaignArguments>();
  command->add_option("FILE", arguments->file, "Campaign, such as validation/campaigns/quick.toml")->required();
  command->add_option("--out", arguments->out, "Directory of its runs and reports (default: runs/<file's name>)");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads of each run (default: OMP_NUM_THREADS, else all processors; with Slurm, the file's or 1)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--checkpoint-every", arguments->checkpoint_every_s, "Seconds between checkpoints of a run")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--dry-run", arguments->dry_run, "Print the plan (with Slurm, the batch scripts), and stop");
  command->add_flag("--force", arguments->force, "Compute finished runs again");
  command->add_flag("--no-report", arguments->no_report, "Runs only");
  command->add_flag("--report-only", arguments->report_only, "Report the runs that are finished, and compute none");
  command->add_option("--only", arguments->only, "Compute this run only, named as in the plan, and make no report");
  command->add_option("--engine", arguments->engine, "Where it is computed: here, or as a job array of a Slurm cluster")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command->add_option("--partition", arguments->partition, "Slurm: partition (default: the file's, or the cluster's)");
  command->add_option(
      "--time-limit", arguments->time_limit,
      "Slurm: of one run's task, such as 12:00:00; a task that runs out of it goes back into the queue");
  command->footer(
      "Finished runs whose inputs have not changed are kept (unless snapshots are asked for that they lack), "
      "unfinished ones go on from their checkpoints, failed ones "
      "are\n"
      "told and do not stop the others. Interrupted, the same command goes on (without --force, which begins anew).\n\n"
      "Examples:\n"
      "  sluice campaign validation/campaigns/quick.toml --dry-run\n"
      "  sluice campaign validation/campaigns/nightly.toml --out runs/nightly\n"
      "  sluice campaign validation/campaigns/nightly.toml --engine slurm --partition compute --time-limit 12:00:00");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace sluice::cli
