// A campaign: many runs from one TOML file, cases x solvers x walls x particle distances x alphas.
//
//   name = "quick"
//   [[runs]]                                # one group, every combination of its lists
//   case = "kleefsman"                      # a name, or a path relative to this file
//   solver = "wcsph"
//   walls = ["extrapolated", "dynamic"]     # default: the solver's default
//   l0_m = [0.03, 0.02]
//   alpha = [0.1, 0.01]                     # of solvers that have it; default: the case's
//   t_end_s = 6.0                           # default: the case's
//   snapshots = true                        # default: none
//   parameters = { delta = 0.1 }            # default: the case's
//   [slurm]                                 # on a cluster: validation/slurm.h
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.h"
#include "validation/plan.h"
#include "validation/run_cost.h"
#include "validation/run_settings.h"
#include "validation/slurm.h"

namespace sluice {

struct CampaignRun {
  std::size_t the_case = 0;  ///< index into Campaign::cases
  RunSettings settings;
  std::filesystem::path directory;
};

struct Campaign {
  std::string name;
  std::vector<Case> cases;
  std::vector<CampaignRun> runs;  ///< in the file's order, lists from left to right, the last varying fastest

  SlurmOptions slurm;  ///< for `--engine slurm`

  const Case& case_of(const CampaignRun& run) const { return cases[run.the_case]; }
};

/// Reads a campaign; its runs go to directories below `out`. `threads` 0: as RunRequest says.
/// Throws CaseError `file:line: key: message`, also where two combinations are the same run, or there are over 10 000.
Campaign load_campaign(const std::filesystem::path& file, const std::filesystem::path& out, int threads);

/// The same from text; `file` is what messages call it.
Campaign parse_campaign(std::string_view text, const std::filesystem::path& file, const std::filesystem::path& out,
                        int threads);

/// Where a run of a campaign stands on disk.
enum class CampaignState {
  absent,
  finished,    ///< with the inputs of today
  resumable,   ///< with the inputs of today, and a checkpoint
  incomplete,  ///< begun, failed or interrupted, without a checkpoint to go on from
  outdated,    ///< from other inputs: another case file, other parameters, without the snapshots asked for; unreadable
};
CampaignState state_of(const Campaign& campaign, const CampaignRun& run);
/// Whether a run has ended with the inputs of today; it may lack snapshots.
bool can_be_reported(const Campaign& campaign, const CampaignRun& run);
/// What is not as asked for in an outdated run: "not as in its run.json: parameters"; empty for others.
std::string why_outdated(const Campaign& campaign, const CampaignRun& run);
std::string to_string(CampaignState state);

/// Makes way for a run's successor (begin_anew.h), and loses nothing: moves a run to the folder `outdated` beside it
/// (as RUN, or RUN-2, RUN-3, ... where there is one), and returns where it is now. Throws std::runtime_error where
/// another program computes there, or where it cannot be moved.
std::filesystem::path set_aside(const std::filesystem::path& run);

/// What a run will cost.
struct CampaignEstimate {
  Plan plan;
  double done_share = 0;  ///< of a run that can be resumed
  double remaining_s() const { return (1 - done_share) * plan.wall_time_s; }
};
/// By what runs have cost here (run_cost.h), or else by plan_run() alone. With `anew` what is there does not count.
CampaignEstimate estimate(const Campaign& campaign, const CampaignRun& run, const std::vector<RunCost>& costs,
                          bool anew = false);

/// Of the campaign's own runs that are finished, and of others (as runs_near() finds them).
std::vector<RunCost> known_costs(const Campaign& campaign, const std::vector<std::filesystem::path>& others);

}  // namespace sluice
