#include "validation/begin_anew.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "validation/checkpoint.h"
#include "validation/plan.h"
#include "validation/progress.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// Whether more would be lost than that a run was begun. What is outdated may be anything.
bool is_worth_keeping(const fs::path& directory, CampaignState state) {
  return state == CampaignState::outdated || state == CampaignState::finished ||
         fs::exists(directory / checkpoint_file) || has_rows(directory);
}

std::string why_anew(const Campaign& campaign, const CampaignRun& run, CampaignState state) {
  switch (state) {
    case CampaignState::outdated:
      return fmt::format("outdated ({})", why_outdated(campaign, run));
    case CampaignState::finished:
      return "finished before";
    case CampaignState::resumable:
      return "unfinished, and of another build";
    default:
      return "unfinished, and without a checkpoint";
  }
}

/// Of a folder whose runs nobody removes: no disk is to be filled unnoticed.
std::string amount_in(const fs::path& folder) {
  std::error_code error;
  int runs = 0;
  double bytes = 0;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    runs += it.depth() == 0 ? 1 : 0;
    std::error_code gone;
    const std::uintmax_t size = it->is_regular_file(gone) ? it->file_size(gone) : 0;
    if (!gone) bytes += static_cast<double>(size);
  }
  return fmt::format("{} {} and {} there by now", runs, runs == 1 ? "run" : "runs", human_bytes(bytes));
}

}  // namespace

RunOutcome begin_anew(const Campaign& campaign, const CampaignRun& run, RunOptions options) {
  options.out = run.directory;
  options.force = true;
  fs::path aside;
  if (const CampaignState state = state_of(campaign, run); is_worth_keeping(run.directory, state)) {
    const std::string why = why_anew(campaign, run, state);
    aside = set_aside(run.directory);
    if (options.progress != nullptr)
      tell(options.progress, fmt::format("{}: kept as {} ({})\n", why, aside.string(), amount_in(aside.parent_path())));
  }
  try {
    return run_case(campaign.case_of(run), run.settings, options);
  } catch (const std::exception&) {
    // Refused: what there is stays where the report looks for it.
    if (!aside.empty() && !fs::exists(run.directory)) fs::rename(aside, run.directory);
    throw;
  }
}

}  // namespace sluice
