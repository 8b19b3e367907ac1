#include "reports/conclusions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/studies.h"
#include "reports/text.h"

namespace sluice::conclusions {

namespace {

TableCell verdict(const Evidence& ours) {
  if (ours.lacks_measurement) return word("no measurement", Tone::missing);
  if (ours.words.empty()) return missing();
  return ours.agrees ? word("agrees", Tone::good) : word("does not agree", Tone::bad);
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

/// Whether a run stands for its method as the case has it: of this program, whole, with the case's parameters.
bool stands_for_its_method(const AnalysedRun& run, const Case& c) {
  return run.record.own && run.record.status() == "finished" && changed_parameters(run.record, c).empty();
}

}  // namespace

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
  BothMethods finest;
  for (const AnalysedRun& run : data.runs) {
    if (run.record.solver != "mps" || !stands_for_its_method(run, data.the_case)) continue;
    BothMethods both;
    both.l0_m = run.record.l0_m;
    for (const AnalysedRun& other : data.runs) {
      if (!stands_for_its_method(other, data.the_case) || !same_flow(data, run.record, other.record)) continue;
      if (other.record.solver == "mps") both.mps.push_back(&other);
      if (other.record.solver == "wcsph" && scope.has(other)) both.wcsph.push_back(&other);
    }
    if (!both.wcsph.empty() && (finest.mps.empty() || both.l0_m < finest.l0_m)) finest = both;
  }
  return finest;
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
