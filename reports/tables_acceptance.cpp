// The case's acceptance rows against every run: one matrix instead of a list a run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

std::string row_range(const AcceptanceRow& row) {
  std::string out = row.walls.empty() ? row.solver : row.solver + ", " + row.walls;
  const bool bounded = std::isfinite(row.l0_max_m) && row.l0_max_m > 0;
  if (bounded && row.l0_min_m > 0)
    out += fmt::format(", l0 {:g} … {:g} mm", 1000 * row.l0_min_m, 1000 * row.l0_max_m);
  else if (bounded)
    out += fmt::format(", l0 ≤ {:g} mm", 1000 * row.l0_max_m);
  if (row.alpha) out += fmt::format(", α = {}", shortest(*row.alpha));
  return row.file.empty() ? out : fmt::format("{} (bands of {})", out, row.file);
}

std::string row_quantity(const AcceptanceRow& row) {
  std::string name = acceptance_name(row);
  if (const std::size_t unit = name.find("_s "); unit != std::string::npos) name.erase(unit, 2);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

TableCell verdict_cell(const AcceptanceCheck& check) {
  if (check.verdict == AcceptanceVerdict::not_applicable) return not_applicable("n/a");
  if (check.verdict == AcceptanceVerdict::missing || !check.value) return missing();
  return {fmt::format("{} {}", acceptance_value_text(check.row, *check.value), to_string(check.verdict)), check.value,
          check.verdict == AcceptanceVerdict::pass ? Tone::good : Tone::bad};
}

bool speaks(const AcceptanceCheck& check) {
  return check.verdict != AcceptanceVerdict::not_applicable;
}

bool applies_to_any(const ReportData& data, std::size_t row) {
  return std::any_of(data.runs.begin(), data.runs.end(),
                     [&](const AnalysedRun& run) { return speaks(run.acceptance.at(row)); });
}

/// Runs that at least one row speaks of; the others would be columns of n/a.
std::vector<const AnalysedRun*> judged_runs(const ReportData& data) {
  std::vector<const AnalysedRun*> runs;
  for (const AnalysedRun& run : data.runs)
    if (std::any_of(run.acceptance.begin(), run.acceptance.end(), speaks)) runs.push_back(&run);
  return runs;
}

/// Why values are missing, each reason once a run.
void add_reasons(Table& table, const ReportData& data) {
  for (const AnalysedRun& run : data.runs) {
    std::vector<std::string> reasons;
    for (const AcceptanceCheck& check : run.acceptance)
      if (check.verdict == AcceptanceVerdict::missing &&
          std::find(reasons.begin(), reasons.end(), check.reason) == reasons.end())
        reasons.push_back(check.reason);
    if (!reasons.empty()) table.notes.push_back(fmt::format("Missing in {}: {}.", run.key, fmt::join(reasons, "; ")));
  }
}

void add_acceptance_notes(Table& table, const ReportData& data, int rows_elsewhere) {
  table.notes.push_back(
      "n/a: not applicable, the row is not meant for that run (other walls, resolution or α). Values in the CSV are "
      "plain numbers: shares of one, seconds, particles.");
  add_reasons(table, data);
  std::string unjudged;
  for (const AnalysedRun& run : data.runs)
    if (std::none_of(run.acceptance.begin(), run.acceptance.end(), speaks))
      unjudged += (unjudged.empty() ? "" : ", ") + run.key;
  if (!unjudged.empty()) table.notes.push_back("There are no bounds for " + unjudged + ": not applicable throughout.");
  if (rows_elsewhere > 0)
    table.notes.push_back(fmt::format("{} more rows apply to none of these runs and are left out.", rows_elsewhere));
}

}  // namespace

Table acceptance_matrix(const ReportData& data) {
  Table table;
  table.name = "acceptance";
  table.caption = "Acceptance rows, evaluated for each run";
  table.columns = {{"Quantity", "quantity", false}, {"Bound", "bound", false}, {"Why this bound", "remark", false}};
  const std::vector<const AnalysedRun*> runs = judged_runs(data);
  for (const AnalysedRun* run : runs) table.columns.push_back({run->key, run->key});
  int elsewhere = 0;
  std::string group;
  for (std::size_t i = 0; i < data.the_case.acceptance.size(); ++i) {
    const AcceptanceRow& row = data.the_case.acceptance[i];
    if (!applies_to_any(data, i)) {
      ++elsewhere;
      continue;
    }
    if (row_range(row) != group) table.add_group("For " + (group = row_range(row)));
    std::vector<TableCell> cells = {word(row_quantity(row)), word(acceptance_band_text(row)), word(row.remark)};
    for (const AnalysedRun* run : runs) cells.push_back(verdict_cell(run->acceptance[i]));
    table.add(std::move(cells));
  }
  add_acceptance_notes(table, data, elsewhere);
  return table;
}

AcceptanceCount count_acceptance(const ReportData& data) {
  AcceptanceCount count;
  for (const AnalysedRun& run : data.runs)
    for (const AcceptanceCheck& check : run.acceptance) {
      count.passed += check.verdict == AcceptanceVerdict::pass;
      count.failed += check.verdict == AcceptanceVerdict::fail;
      count.missing += check.verdict == AcceptanceVerdict::missing;
    }
  return count;
}

}  // namespace sluice
