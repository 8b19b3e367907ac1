// Runs that end before the window does, beside all that reach as far.
#include <fmt/format.h>

#include <algorithm>

#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

/// The same time by the sampling of two runs.
constexpr double alike_s = 0.01;

std::optional<double> last_s(const AnalysedRun& run) {
  const std::vector<double>& t = run.record.probes.times_s();
  return t.empty() ? std::nullopt : std::optional(t.back());
}

/// Whether the run ends before the window does, but not at its very beginning.
bool ends_early(const ReportData& data, const AnalysedRun& run) {
  constexpr double least_s = 0.5;
  const std::vector<double>& t = run.record.probes.times_s();
  const auto last = last_s(run);
  return last && *last >= data.window.begin_s + least_s && !reaches_end({t, t}, data.window);
}

/// Where runs end early, of ends alike the first.
std::vector<double> early_ends_s(const ReportData& data) {
  std::vector<double> ends;
  for (const AnalysedRun& run : data.runs)
    if (ends_early(data, run)) ends.push_back(*last_s(run));
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < alike_s; }), ends.end());
  return ends;
}

/// Of a load: peak (after a running mean) and impulse. Of a height: RMSE over the range. All in per cent.
std::vector<TableCell> early_metrics(const ReportData& data, const AnalysedRun& run, const std::string& sensor,
                                     double end_s) {
  const Window whole = data.window_of(sensor);
  const Window window{whole.begin_s, std::min(whole.end_s, end_s)};
  const SensorReading* reading = run.primary(sensor);
  const MeasuredSeries* measured = data.measured_series(sensor);
  const bool is_load = data.the_case.find_sensor(sensor)->kind != SensorKind::wave_height;
  if (reading == nullptr || measured == nullptr) return std::vector<TableCell>(is_load ? 2 : 1, missing());
  const auto percent = [](std::optional<double> share) { return signed_number(scaled(share, 100), 1); };
  if (is_load) {
    const double smoothing_s = ComparisonOptions().smoothing_s;
    const auto height = [](const std::optional<Peak>& peak) {
      return peak ? std::optional(peak->value) : std::nullopt;
    };
    return {percent(relative_deviation(height(smoothed_peak(reading->series, window, smoothing_s)),
                                       height(smoothed_peak(*measured, window, smoothing_s)))),
            percent(relative_deviation(impulse(reading->series, window), impulse(*measured, window)))};
  }
  const auto error = rmse(reading->series, *measured, window);
  const auto spread = range(*measured, whole);
  return {number(error && spread && *spread > 0 ? std::optional(100 * *error / *spread) : std::nullopt, 1)};
}

}  // namespace

Table early_runs_table(const ReportData& data) {
  Table table;
  table.name = "early_runs";
  table.caption =
      "Runs that end before the window does, scored over what they cover, beside all that reach as far (primary "
      "readings)";
  table.columns = {{"Run", "run", false}, {"Up to [s]", "up_to_s"}};
  std::vector<std::string> sensors = data.headline_sensors();
  for (const std::string& sensor : sensors) {
    table.columns.push_back({sensor + " peak [%]", sensor + "_smoothed_peak_deviation_percent"});
    table.columns.push_back({sensor + " impulse [%]", sensor + "_impulse_deviation_percent"});
  }
  for (const std::string& sensor : data.sensors(SensorKind::wave_height)) {
    sensors.push_back(sensor);
    table.columns.push_back({sensor + " RMSE / range [%]", sensor + "_rmse_over_range_percent"});
  }
  for (const double end_s : early_ends_s(data)) {
    table.add_group(fmt::format("Up to {} s", fixed(end_s, 2)));
    for (const AnalysedRun& run : data.runs) {
      if (last_s(run).value_or(0) < end_s) continue;
      const bool ends_there = *last_s(run) - end_s < alike_s && ends_early(data, run);
      std::vector<TableCell> cells = {word(run.label + (ends_there ? " (ends there)" : "")), number(end_s, 2)};
      for (const std::string& sensor : sensors)
        for (TableCell& cell : early_metrics(data, run, sensor, end_s)) cells.push_back(std::move(cell));
      table.add(std::move(cells));
    }
  }
  table.notes.push_back(
      "Peaks (of a 10 ms running mean) and impulses: signed deviation from what was measured over the same time. RMSE: "
      "over the range measured in the whole window. These numbers enter no ranking, no figure and no acceptance row: a "
      "run that stopped early has not shown what comes "
      "after.");
  return table;
}

}  // namespace sluice
