#include "reports/conclusions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

bool is_whole(const AnalysedRun& run, const std::string& solver) {
  return run.record.own && run.record.status() == "finished" && run.record.solver == solver;
}

bool reaches_the_end(const ReportData& data, double t_end_s) {
  return t_end_s >= data.window.end_s * (1 - 1e-9);
}

/// Runs that reach the window's end come before others, then the finer ones.
bool tells_more(const ReportData& data, const BothMethods& a, const BothMethods& b) {
  if (b.mps.empty()) return true;
  const auto end_s = [](const BothMethods& both) { return both.mps.front()->record.number("t_end_s").value_or(0); };
  const bool whole_a = reaches_the_end(data, end_s(a));
  const bool whole_b = reaches_the_end(data, end_s(b));
  return whole_a != whole_b ? whole_a : a.l0_m < b.l0_m;
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

std::map<std::string, double> judged_parameters(const ReportData& data, const std::string& solver) {
  std::map<std::map<std::string, double>, int> runs;
  for (const AnalysedRun& run : data.runs)
    if (is_whole(run, solver)) ++runs[changed_parameters(run.record, data.the_case)];
  if (runs.empty() || runs.contains({})) return {};
  return std::max_element(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

void note_judged_parameters(Table& table, const ReportData& data) {
  for (const auto& [solver, name] : {std::pair("mps", "MPS"), std::pair("wcsph", "WCSPH")})
    if (const std::string text = parameters_text(judged_parameters(data, solver)); !text.empty())
      table.notes.push_back(fmt::format("{} is judged by its runs with {}: none has the case's parameters throughout.",
                                        name, text.substr(2)));
}

std::vector<const AnalysedRun*> judged_runs(const ReportData& data, const std::string& solver,
                                            const WallsScope& scope) {
  const auto parameters = judged_parameters(data, solver);
  std::vector<const AnalysedRun*> runs;
  for (const AnalysedRun& run : data.runs)
    if (is_whole(run, solver) && scope.has(run) && changed_parameters(run.record, data.the_case) == parameters)
      runs.push_back(&run);
  return runs;
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
  BothMethods finest;
  const auto mps = judged_runs(data, "mps");
  const auto wcsph = judged_runs(data, "wcsph", scope);
  for (const AnalysedRun* run : mps) {
    BothMethods both;
    both.l0_m = run->record.l0_m;
    const auto alike = [&](const AnalysedRun* other) { return same_flow(data, run->record, other->record); };
    std::copy_if(mps.begin(), mps.end(), std::back_inserter(both.mps), alike);
    std::copy_if(wcsph.begin(), wcsph.end(), std::back_inserter(both.wcsph), alike);
    if (!both.wcsph.empty() && tells_more(data, both, finest)) finest = both;
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
