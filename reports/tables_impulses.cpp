// Tables of pressure impulses: the paper's own form, and the full one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

std::optional<double> measured_impulse(const ReportData& data, const std::string& sensor) {
  const MeasuredSeries* series = data.measured_series(sensor);
  return series == nullptr ? std::nullopt : impulse(*series, data.window_of(sensor));
}

const PublishedImpulse* find_published(const Published& published, const PublishedImpulse& like,
                                       const std::string& sensor) {
  for (const PublishedImpulse& row : published.impulses)
    if (row.sensor == sensor && row.source == like.source && row.alpha == like.alpha) return &row;
  return nullptr;
}

std::string source_name(const PublishedImpulse& row) {
  if (row.source == "experiment") return "Paper: experiment, as printed";
  return "Paper: " + method_name(row.source) + (row.alpha ? fmt::format(", α = {}", shortest(*row.alpha)) : "");
}

void add_published_rows(Table& table, const ReportData& data, const std::vector<std::string>& sensors) {
  std::vector<std::string> done;
  for (const PublishedImpulse& first : data.the_case.published.impulses) {
    const std::string name = source_name(first);
    if (std::find(done.begin(), done.end(), name) != done.end()) continue;
    done.push_back(name);
    std::vector<TableCell> cells = {word(name), word(first.source == "experiment" ? "–" : "the paper's own")};
    for (const std::string& sensor : sensors) {
      const PublishedImpulse* row = find_published(data.the_case.published, first, sensor);
      cells.push_back(row == nullptr ? missing() : number(row->impulse_Pa_s, 0));
      cells.push_back(row == nullptr || !row->deviation_percent ? not_applicable()
                                                                : number(*row->deviation_percent, 1));
    }
    table.add(std::move(cells));
  }
}

void add_experiment_row(Table& table, const ReportData& data, const std::vector<std::string>& sensors) {
  std::vector<TableCell> cells = {word("Experiment, from the digest", Tone::strong), word("–")};
  for (const std::string& sensor : sensors) {
    cells.push_back(number(measured_impulse(data, sensor), 0));
    cells.push_back(not_applicable());
  }
  table.add(std::move(cells));
}

/// One run read by one model.
struct RunRow {
  const AnalysedRun* run = nullptr;
  std::string model;
  std::string model_name;
};

/// Every run with its primary reading first, then the other readings of all runs.
struct RunRows {
  std::vector<RunRow> primary;
  std::vector<RunRow> others;
};

RunRows run_rows(const ReportData& data, const std::vector<std::string>& sensors) {
  RunRows rows;
  for (const AnalysedRun& run : data.runs) {
    std::vector<std::string> seen;
    for (const std::string& sensor : sensors)
      for (const SensorReading* reading : run.of(sensor)) {
        if (std::find(seen.begin(), seen.end(), reading->model) != seen.end()) continue;
        seen.push_back(reading->model);
        (reading->primary ? rows.primary : rows.others).push_back({&run, reading->model, reading->remarked_model()});
      }
    if (seen.empty()) rows.primary.push_back({&run, "", "missing"});
  }
  return rows;
}

/// Both kinds of rows under their headings; `cells` makes what follows the run's name and model.
template <class Cells>
void add_run_rows(Table& table, const ReportData& data, const std::vector<std::string>& sensors, Cells cells) {
  const RunRows rows = run_rows(data, sensors);
  for (const auto& [title, list] :
       {std::pair("Runs, primary readings", &rows.primary), std::pair("Runs, other sensor models", &rows.others)}) {
    if (list->empty()) continue;
    table.add_group(title);
    for (const RunRow& row : *list) {
      std::vector<TableCell> line = {word(row.run->label), word(row.model_name)};
      for (const std::string& sensor : sensors) {
        const SensorReading* reading = row.run->find(sensor, row.model);
        for (TableCell& cell : cells(reading == nullptr ? Pair{} : reading->comparison.impulse))
          line.push_back(std::move(cell));
      }
      table.add(std::move(line));
    }
  }
}

}  // namespace

Table paper_impulses_table(const ReportData& data) {
  const std::vector<std::string> sensors = data.headline_sensors();
  Table table;
  table.name = "table2_impulses";
  const Window window = sensors.empty() ? data.window : data.window_of(sensors.front());
  table.caption = fmt::format("Pressure impulses {} to {} s and unsigned deviations, after the paper's Table {}",
                              shortest(window.begin_s), shortest(window.end_s),
                              std::max(2, data.the_case.published.impulses_table));
  table.columns = {{"Source", "source", false}, {"Sensor model", "model", false}};
  for (const std::string& sensor : sensors) {
    table.columns.push_back({sensor + " [Pa s]", sensor + "_Pa_s"});
    table.columns.push_back({sensor + " off by [%]", sensor + "_unsigned_deviation_percent"});
  }
  table.add_group("Measured and published");
  add_experiment_row(table, data, sensors);
  add_published_rows(table, data, sensors);
  add_run_rows(table, data, sensors, [](const Pair& pair) {
    return std::vector<TableCell>{number(pair.simulated, 0),
                                  number(scaled(unsigned_relative_deviation(pair.simulated, pair.measured), 100), 1)};
  });
  table.notes.push_back(
      "Deviations as in the paper: |simulated − measured| / measured. The signed ones stand in the next table. "
      "“Primary” "
      "is the sensor model that the case names for a solver and its walls; the others are shown beside it, never in "
      "its "
      "place. “Warning only”: the pressure of dynamic wall particles, which can rise but never fall.");
  return table;
}

Table impulses_table(const ReportData& data, bool relative) {
  const std::vector<std::string> sensors = data.sensors(SensorKind::pressure);
  Table table;
  table.name = relative ? "impulse_deviations" : "impulses";
  table.caption = relative ? "Signed deviation of every pressure impulse, (simulated − measured) / measured [%]"
                           : "Impulse of every pressure sensor [Pa s]";
  table.columns = {{"Run", "run", false}, {"Sensor model", "model", false}};
  for (const std::string& sensor : sensors)
    table.columns.push_back({sensor + (relative ? " [%]" : " [Pa s]"), sensor + (relative ? "_percent" : "_Pa_s")});
  if (!relative) {
    table.add_group("Measured");
    std::vector<TableCell> cells = {word("Experiment", Tone::strong), word("–")};
    for (const std::string& sensor : sensors) cells.push_back(number(measured_impulse(data, sensor), 0));
    table.add(std::move(cells));
  }
  add_run_rows(table, data, sensors, [&](const Pair& pair) {
    return std::vector<TableCell>{relative ? signed_number(scaled(pair.deviation(), 100), 1)
                                           : number(pair.simulated, 0)};
  });
  return table;
}

}  // namespace sluice
