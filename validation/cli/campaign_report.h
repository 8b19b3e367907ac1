// The reports of a campaign over what is there.
#pragma once

#include <filesystem>
#include <string>

#include "validation/campaign.h"

namespace sluice::cli {

/// Why an outdated run is that, as the end of a line: " (without the snapshots asked for)"; empty for others.
std::string reason(const Campaign& campaign, const CampaignRun& run);

/// One report a case, over its runs that have ended well, with or without snapshots, in out/report-CASE.
void report_cases(const Campaign& campaign, const std::filesystem::path& out);

/// The same, and lists what is not finished; returns 0 when all runs are, with or without snapshots.
int report_only(const Campaign& campaign, const std::filesystem::path& out);

}  // namespace sluice::cli
