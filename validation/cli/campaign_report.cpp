#include "validation/cli/campaign_report.h"

#include <fmt/format.h>

#include <vector>

#include "reports/report.h"
#include "validation/progress.h"

namespace sluice::cli {

namespace fs = std::filesystem;

std::string reason(const Campaign& campaign, const CampaignRun& run) {
  const std::string why = why_outdated(campaign, run);
  return why.empty() ? "" : fmt::format(" ({})", why);
}

void report_cases(const Campaign& campaign, const fs::path& out) {
  for (const Case& c : campaign.cases) {
    std::vector<fs::path> directories;
    for (const CampaignRun& run : campaign.runs)
      if (&campaign.case_of(run) == &c && can_be_reported(campaign, run)) directories.push_back(run.directory);
    if (directories.empty()) continue;
    const fs::path folder = out / ("report-" + c.name);
    write_report(directories, folder);
    tell(stdout, fmt::format("report: {}\n", (folder / "index.html").string()));
  }
}

int report_only(const Campaign& campaign, const fs::path& out) {
  report_cases(campaign, out);
  int code = 0;
  for (const CampaignRun& run : campaign.runs) {
    if (state_of(campaign, run) == CampaignState::finished) continue;
    fmt::print("{:12} {}{}\n", to_string(state_of(campaign, run)), run.directory.filename().string(),
               reason(campaign, run));
    if (!can_be_reported(campaign, run)) code = 1;
  }
  return code;
}

}  // namespace sluice::cli
