// Which of our runs another code's are drawn beside.
#include <algorithm>

#include "reports/studies.h"

namespace sluice {

namespace {

/// The finest finished run of each solver and walls, with the case's parameters where there is such a one.
std::vector<const AnalysedRun*> references(const ReportData& data) {
  std::vector<const AnalysedRun*> found;
  const auto rank = [&](const AnalysedRun& run) {
    return std::pair(!changed_parameters(run.record, data.the_case).empty(), run.record.l0_m);
  };
  for (const AnalysedRun& run : data.runs) {
    if (!run.record.own || run.record.status() != "finished") continue;
    const auto twin =
        std::find_if(found.begin(), found.end(), [&](const AnalysedRun* other) { return other->group == run.group; });
    if (twin == found.end())
      found.push_back(&run);
    else if (rank(run) < rank(**twin))
      *twin = &run;
  }
  return found;
}

}  // namespace

std::vector<RunGroup> beside_references(const ReportData& data, std::size_t limit) {
  std::vector<const AnalysedRun*> ours = references(data);
  std::vector<const AnalysedRun*> others;
  for (const AnalysedRun& run : data.runs)
    if (!run.record.own) others.push_back(&run);
  if (others.empty() || ours.size() + others.size() < 2) return {};
  ours.resize(std::min(ours.size(), limit - 1));
  std::vector<RunGroup> groups;
  const std::size_t room = limit - ours.size();
  for (std::size_t k = 0; k < others.size(); k += room) {
    RunGroup group{"other codes and the finest run of each method", ours};
    const auto from = others.begin() + static_cast<std::ptrdiff_t>(k);
    group.runs.insert(group.runs.end(), from, from + static_cast<std::ptrdiff_t>(std::min(room, others.size() - k)));
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace sluice
