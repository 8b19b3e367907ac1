// The ledger as one page that needs neither network nor server.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ci/findings.h"
#include "ci/ledger.h"

namespace sluice::ci {

/// The page's HTML. Links to runs on this disk are written relative to `directory`.
std::string dashboard_page(const Ledger& ledger, const std::vector<SeriesFindings>& all,
                           const std::filesystem::path& directory);

/// Writes it, with its directory; a reader sees the old page or the new one. Throws std::runtime_error naming the file.
void write_dashboard(const std::filesystem::path& file, const Ledger& ledger, const std::vector<SeriesFindings>& all);

}  // namespace sluice::ci
