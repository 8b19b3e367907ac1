// Studies take runs as alike in all but one thing. A build is such a thing too.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/studies.h"

namespace sluice {

namespace {

/// "The study of resolution (WCSPH ...) holds runs of several builds: 2f5db0f3 (R1, R2), 94fbc89a (R3)", or "".
std::string mixture(const std::string& study, const std::vector<const AnalysedRun*>& runs) {
  constexpr std::size_t shown_of_a_commit = 12;
  std::vector<std::pair<std::string, std::vector<std::string>>> builds;
  for (const AnalysedRun* run : runs) {
    const std::string commit = run->record.text("commit").value_or("").substr(0, shown_of_a_commit);
    if (commit.empty()) continue;  // another code's, whose builds are its own affair
    auto found = std::find_if(builds.begin(), builds.end(), [&](const auto& build) { return build.first == commit; });
    if (found == builds.end()) found = builds.insert(builds.end(), {commit, {}});
    found->second.push_back(run->key);
  }
  if (builds.size() < 2) return "";
  std::vector<std::string> parts;
  for (const auto& [commit, keys] : builds) parts.push_back(fmt::format("{} ({})", commit, fmt::join(keys, ", ")));
  return fmt::format("{} holds runs of several builds: {}", study, fmt::join(parts, ", "));
}

}  // namespace

std::vector<std::string> mixed_builds(const ReportData& data) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& study, const std::vector<const AnalysedRun*>& runs) {
    if (std::string text = mixture(study, runs); !text.empty()) out.push_back(std::move(text));
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
