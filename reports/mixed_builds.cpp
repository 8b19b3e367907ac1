// Studies take runs as alike in all but one thing. A build is such a thing too, and so is a processor, whose vectors
// decide the order of sums.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "reports/studies.h"

namespace sluice {

namespace {

/// "The study of resolution (WCSPH ...) holds runs of several builds: 2f5db0f3 (R1, R2), 94fbc89a (R3)", or "". Runs
/// without the fact are other codes', whose builds are their own affair.
std::string mixture(const std::string& study, const std::vector<const AnalysedRun*>& runs, std::string_view fact,
                    std::string_view plural, std::size_t shown) {
  std::vector<std::pair<std::string, std::vector<std::string>>> kinds;
  for (const AnalysedRun* run : runs) {
    const std::string kind = run->record.text(fact).value_or("").substr(0, shown);
    if (kind.empty()) continue;
    auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& known) { return known.first == kind; });
    if (found == kinds.end()) found = kinds.insert(kinds.end(), {kind, {}});
    found->second.push_back(run->key);
  }
  if (kinds.size() < 2) return "";
  std::vector<std::string> parts;
  for (const auto& [kind, keys] : kinds) parts.push_back(fmt::format("{} ({})", kind, fmt::join(keys, ", ")));
  return fmt::format("{} holds runs of several {}: {}", study, plural, fmt::join(parts, ", "));
}

}  // namespace

std::vector<std::string> mixed_builds(const ReportData& data) {
  constexpr std::size_t shown_of_a_commit = 12;
  std::vector<std::string> out;
  const auto add = [&](const std::string& study, const std::vector<const AnalysedRun*>& runs) {
    for (std::string text : {mixture(study, runs, "commit", "builds", shown_of_a_commit),
                             mixture(study, runs, "machine", "machines", std::string::npos)})
      if (!text.empty()) out.push_back(std::move(text));
  };
  for (const ResolutionSeries& series : resolution_series(data))
    add("The study of resolution (" + series.title + ")", series.runs);
  for (const AlphaSeries& series : alpha_series(data)) add("The study of alpha (" + series.title + ")", series.runs);
  for (const auto& [first, second] : wall_pairs(data)) add("The comparison of walls", {first, second});
  for (const PlacementSeries& series : placement_series(data))
    add("The study of " + series.placement + " (" + series.title + ")", series.runs);
  return out;
}

}  // namespace sluice
