#include "reports/conclusions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "reports/studies.h"
#include "reports/text.h"

namespace sluice::conclusions {

namespace {

constexpr double scatter_of_runs = 0.1;

TableCell verdict(const Evidence& ours) {
  if (ours.verdict == Verdict::no_measurement) return word("no measurement", Tone::missing);
  if (ours.words.empty()) return missing();
  if (ours.verdict == Verdict::not_told) return word("no difference told");
  return ours.verdict == Verdict::agrees ? word("agrees", Tone::good) : word("does not agree", Tone::bad);
}

void remember(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// In the report's own order of runs.
std::vector<std::string> wcsph_walls(const ReportData& data) {
  std::vector<std::string> walls;
  for (const AnalysedRun& run : data.runs)
    if (run.record.own && run.record.solver == "wcsph") remember(walls, run.record.walls);
  return walls;
}

std::vector<WallsScope> scopes_of(const std::vector<std::string>& walls) {
  if (walls.size() < 2) return {WallsScope{}};
  std::vector<WallsScope> scopes;
  for (const std::string& name : walls) scopes.push_back({name});
  return scopes;
}

std::vector<const AnalysedRun*> finished_runs(const ReportData& data, const std::string& solver,
                                              const WallsScope& scope) {
  std::vector<const AnalysedRun*> runs;
  for (const AnalysedRun& run : data.runs)
    if (run.record.own && run.record.status() == "finished" && run.record.solver == solver && scope.has(run))
      runs.push_back(&run);
  return runs;
}

/// Those that reach the window's end, if any do.
std::vector<const AnalysedRun*> ended_runs(const ReportData& data, const std::string& solver, const WallsScope& scope) {
  std::vector<const AnalysedRun*> runs = finished_runs(data, solver, scope);
  const auto whole = [&](const AnalysedRun* run) { return is_whole(data, run->record); };
  if (std::any_of(runs.begin(), runs.end(), whole)) std::erase_if(runs, std::not_fn(whole));
  return runs;
}

/// Of the runs of one solver.
std::vector<const AnalysedRun*> with_judged_parameters(const ReportData& data, const std::string& solver,
                                                       const WallsScope& scope, std::vector<const AnalysedRun*> runs) {
  const auto parameters = judged_parameters(data, solver, scope);
  std::erase_if(runs,
                [&](const AnalysedRun* run) { return changed_parameters(run->record, data.the_case) != parameters; });
  return runs;
}

/// Those of one flow at the finest particle distance that has both.
BothMethods finest_pair(const ReportData& data, const std::vector<const AnalysedRun*>& mps,
                        const std::vector<const AnalysedRun*>& wcsph) {
  BothMethods finest;
  for (const AnalysedRun* run : mps) {
    BothMethods both;
    both.l0_m = run->record.l0_m;
    const auto alike = [&](const AnalysedRun* other) { return same_flow(data, run->record, other->record); };
    std::copy_if(mps.begin(), mps.end(), std::back_inserter(both.mps), alike);
    std::copy_if(wcsph.begin(), wcsph.end(), std::back_inserter(both.wcsph), alike);
    if (!both.wcsph.empty() && (finest.mps.empty() || both.l0_m < finest.l0_m)) finest = both;
  }
  return finest;
}

}  // namespace

Verdict smaller(double claimed, double other) {
  if (claimed < (1 - scatter_of_runs) * other) return Verdict::agrees;
  return other < (1 - scatter_of_runs) * claimed ? Verdict::does_not_agree : Verdict::not_told;
}

Verdict all_of(Verdict a, Verdict b) {
  for (const Verdict worst : {Verdict::no_measurement, Verdict::does_not_agree, Verdict::not_told})
    if (a == worst || b == worst) return worst;
  return Verdict::agrees;
}

std::map<std::string, double> judged_parameters(const ReportData& data, const std::string& solver,
                                                const WallsScope& scope) {
  std::map<std::map<std::string, double>, int> runs;
  for (const AnalysedRun* run : ended_runs(data, solver, scope)) ++runs[changed_parameters(run->record, data.the_case)];
  if (runs.empty() || runs.contains({})) return {};
  return std::max_element(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

void note_judged_parameters(Table& table, const ReportData& data) {
  const auto note = [&](const std::string& solver, const std::string& name, const WallsScope& scope) {
    if (const std::string text = parameters_text(judged_parameters(data, solver, scope)); !text.empty())
      table.notes.push_back(fmt::format(
          "In statements on both methods and on signs, {} is judged by its runs with {}: none has the case's "
          "parameters.",
          scope.named(name), text.substr(2)));
  };
  note("mps", "MPS", {});
  for (const WallsScope& scope : walls_scopes(data)) note("wcsph", "WCSPH", scope);
}

std::vector<const AnalysedRun*> judged_runs(const ReportData& data, const std::string& solver,
                                            const WallsScope& scope) {
  return with_judged_parameters(data, solver, scope, ended_runs(data, solver, scope));
}

void add(Table& table, const std::string& statement, const std::string& paper, const Evidence& ours) {
  table.add({word(statement), word(paper.empty() ? "missing" : paper),
             ours.words.empty() ? missing() : word(ours.words), verdict(ours)});
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

std::string WallsScope::named(const std::string& statement) const {
  if (!walls) return statement;
  if (walls->empty()) return statement + ", walls not stated";
  return fmt::format("{}, {} walls{}", statement, *walls, *walls == "dynamic" ? " (the paper's)" : "");
}

std::vector<WallsScope> walls_scopes(const ReportData& data) {
  return scopes_of(wcsph_walls(data));
}

std::vector<WallsScope> alpha_scopes(const ReportData& data) {
  std::vector<std::string> walls = wcsph_walls(data);
  for (const AlphaSeries& series : alpha_series(data)) remember(walls, series.runs.front()->record.walls);
  return scopes_of(walls);
}

BothMethods finest_of_both(const ReportData& data, const WallsScope& scope) {
  BothMethods whole = finest_pair(data, judged_runs(data, "mps"), judged_runs(data, "wcsph", scope));
  if (!whole.mps.empty()) return whole;
  return finest_pair(data, with_judged_parameters(data, "mps", {}, finished_runs(data, "mps", {})),
                     with_judged_parameters(data, "wcsph", scope, finished_runs(data, "wcsph", scope)));
}

ShownSensors shown_sensors(const ReportData& data, SensorKind kind) {
  ShownSensors shown;
  std::string numbers;
  for (const PublishedFigure& figure : data.the_case.published.figures) {
    const CaseSensor* sensor = data.the_case.find_sensor(figure.sensor);
    if (sensor == nullptr || sensor->kind != kind) continue;
    shown.names.push_back(figure.sensor);
    numbers += fmt::format("{}{}", numbers.empty() ? "" : ", ", figure.number);
  }
  shown.evidence =
      fmt::format("its {} {}; no numbers are printed", shown.names.size() > 1 ? "figures" : "figure", numbers);
  return shown;
}

std::vector<double> published_alphas(const ReportData& data) {
  const PublishedRun* run = published_run(data.the_case, "wcsph");
  return run == nullptr ? std::vector<double>{} : run->alpha;
}

}  // namespace sluice::conclusions
