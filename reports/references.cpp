// Which of our runs another code's are drawn beside.
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/studies.h"

namespace sluice {

namespace {

/// Of each solver and walls the run that stands for it: whole, with the case's parameters and alpha, the finest.
std::vector<const AnalysedRun*> references(const ReportData& data) {
  std::vector<const AnalysedRun*> found;
  const auto rank = [&](const AnalysedRun& run) {
    const SolverOption* solver = data.the_case.find_solver(run.record.solver);
    const auto alpha = run.record.alpha();
    const bool other_alpha =
        alpha && solver != nullptr && solver->parameters.contains("alpha") && *alpha != solver->parameters.at("alpha");
    return std::tuple(!is_whole(data, run.record), !changed_parameters(run.record, data.the_case).empty(), other_alpha,
                      run.record.l0_m);
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
  const std::size_t count = (others.size() + room - 1) / room;
  for (std::size_t g = 0; g < count; ++g) {
    RunGroup group{ours.empty() ? "other codes" : "other codes and a run of each method here", ours};
    for (std::size_t k = g; k < others.size(); k += count) group.runs.push_back(others[k]);  // mixed: they are sorted
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace sluice
