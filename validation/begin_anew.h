// Runs in directories of a command's own: what was computed there before is not lost to what is computed now.
#pragma once

#include "validation/campaign.h"
#include "validation/run.h"

namespace sluice {

/// run_case() of a campaign's run, from its beginning and into its directory (`options.out` and `options.force` do not
/// count). What was computed there is set aside (campaign.h), and options.progress is told why, where, and how much
/// lies there by now; a run of ours that has neither rows nor a checkpoint is replaced. Where the new run is refused,
/// the old one comes back. Throws as run_case() and set_aside() do.
RunOutcome begin_anew(const Campaign& campaign, const CampaignRun& run, RunOptions options);

}  // namespace sluice
