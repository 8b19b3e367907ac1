// Tables of every metric at every sensor.
#include <fmt/format.h>

#include <algorithm>

#include "reports/quantity.h"
#include "reports/tables.h"
#include "reports/text.h"
#include "validation/sensors.h"

namespace sluice {

namespace {

std::vector<TableColumn> metric_columns(SensorKind kind) {
  const std::string unit(unit_of(kind));
  auto with_unit = [&](const std::string& name) { return fmt::format("{} [{}]", name, quantity_of(kind).unit); };
  return {{"Sensor and run", "run", false},
          {"Model", "model", false},
          {"Arrival [s]", "arrival_s"},
          {"Later by [ms]", "arrival_difference_ms"},
          {with_unit("Peak"), "peak_" + unit},
          {"at [s]", "peak_time_s"},
          {"off by [%]", "peak_deviation_percent"},
          {with_unit("10 ms mean peak"), "smoothed_peak_" + unit},
          {"at [s]", "smoothed_peak_time_s"},
          {"off by [%]", "smoothed_peak_deviation_percent"},
          {with_unit("RMSE"), "rmse_" + unit},
          {"RMSE / range [%]", "rmse_over_range_percent"},
          {"Best lag [ms]", "best_lag_ms"},
          {"Correlation", "correlation"},
          {"Inside band [%]", "inside_band_percent"},
          {with_unit("Noise"), "noise_" + unit}};
}

void add_measured(Table& table, SensorKind kind, const Comparison& c) {
  const int d = quantity_of(kind).decimals;
  const TableCell none = not_applicable();
  table.add({word("Experiment", Tone::strong), none, number(c.arrival_s.measured, 3), none, number(c.peak.measured, d),
             number(c.peak_time_s.measured, 3), none, number(c.smoothed_peak.measured, d),
             number(c.smoothed_peak_time_s.measured, 3), none, none, none, none, none, none,
             number(c.noise.measured, d)});
}

void add_reading(Table& table, const ReportData& data, const AnalysedRun& run, const SensorReading& reading) {
  const Comparison& c = reading.comparison;
  const int d = quantity_of(reading.kind).decimals;
  table.add({word(run.label), word(reading.remarked_model()), number(c.arrival_s.simulated, 3),
             signed_number(scaled(c.arrival_s.difference(), 1000), 0), number(c.peak.simulated, d),
             number(c.peak_time_s.simulated, 3), signed_number(scaled(c.peak.deviation(), 100), 1),
             number(c.smoothed_peak.simulated, d), number(c.smoothed_peak_time_s.simulated, 3),
             signed_number(scaled(c.smoothed_peak.deviation(), 100), 1), number(c.rmse, d),
             number(scaled(c.rmse_over_range, 100), 1), signed_number(scaled(c.lag_s, 1000), 0),
             number(c.correlation, 2), inside_band(data, reading), number(c.noise.simulated, d)});
}

void add_missing(Table& table, const AnalysedRun& run) {
  std::vector<TableCell> cells(table.columns.size(), missing());
  cells[0] = word(run.label);
  table.add(std::move(cells));
}

}  // namespace

TableCell inside_band(const ReportData& data, const SensorReading& reading) {
  const CaseSensor* sensor = data.the_case.find_sensor(reading.sensor);
  if (sensor != nullptr && !sensor->measured_is_band && data.measured_series(reading.sensor) != nullptr)
    return not_applicable();
  return number(scaled(reading.comparison.share_inside_band, 100), 0);
}

Table sensor_metrics_table(const ReportData& data, SensorKind kind, bool all_models) {
  Table table;
  table.name = quantity_of(kind).stem + "_metrics" + (all_models ? "_all_models" : "");
  const std::vector<std::string> sensors = data.sensors(kind);
  const Window window = sensors.empty() ? data.window : data.window_of(sensors.front());
  table.caption = fmt::format("{} over {} to {} s, {}", quantity_of(kind).title, shortest(window.begin_s),
                              shortest(window.end_s), all_models ? "every sensor model" : "primary readings");
  table.columns = metric_columns(kind);
  for (const std::string& sensor : sensors) {
    const Window own = data.window_of(sensor);
    const bool alike = own.begin_s == window.begin_s && own.end_s == window.end_s;
    table.add_group(alike ? sensor : fmt::format("{}, {} to {} s", sensor, shortest(own.begin_s), shortest(own.end_s)));
    if (const std::string remark = data.measured_remark(sensor); !remark.empty())
      table.notes.push_back(sensor + ": " + remark);
    bool measured_shown = false;
    for (const AnalysedRun& run : data.runs) {
      const auto readings = run.of(sensor);
      if (readings.empty()) add_missing(table, run);
      for (const SensorReading* reading : readings) {
        if (!measured_shown && reading->comparison.peak.measured) {
          add_measured(table, kind, reading->comparison);
          measured_shown = true;
        }
        if (all_models || reading->primary) add_reading(table, data, run, *reading);
      }
    }
  }
  const auto any_measured = [&](bool without_band) {
    return std::any_of(sensors.begin(), sensors.end(), [&](const std::string& sensor) {
      return data.measured_series(sensor) != nullptr &&
             !(without_band && data.the_case.find_sensor(sensor)->measured_is_band);
    });
  };
  if (any_measured(true)) table.notes.push_back("Inside band: a dash where the measurement is no band.");
  if (any_measured(false))
    table.notes.push_back(
        "The experiment's noise is that of the digest's bin means, so only of what is slower than a bin: less than the "
        "recording has, and not to be held against the runs'. Bins too wide for a 10 ms mean, or for any noise, tell "
        "none: both are missing then.");
  return table;
}

namespace {

/// Share of the samples within a window whose support suffices for a reading.
std::optional<double> share_seen(const AnalysedRun& run, const std::string& sensor, Window window) {
  const std::string column = sensor + "_kernel_support_1";
  if (!run.record.probes.has(column)) return std::nullopt;
  const std::vector<double>& support = run.record.probes.values(column);
  const std::vector<double>& times = run.record.probes.times_s();
  std::size_t all = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < window.begin_s || times[i] > window.end_s) continue;
    ++all;
    seen += support[i] >= minimum_kernel_support;
  }
  return all == 0 ? std::nullopt : std::optional<double>(static_cast<double>(seen) / static_cast<double>(all));
}

}  // namespace

Table kernel_support_table(const ReportData& data) {
  const std::vector<std::string> sensors = data.sensors(SensorKind::pressure);
  Table table;
  table.name = "kernel_support";
  table.caption = "Share of the time after the measured arrival in which the kernel probe had fluid enough to read [%]";
  table.columns = {{"Run", "run", false}};
  for (const std::string& sensor : sensors) table.columns.push_back({sensor + " [%]", sensor + "_percent"});
  for (const AnalysedRun& run : data.runs) {
    std::vector<TableCell> cells = {word(run.label)};
    for (const std::string& sensor : sensors) {
      const MeasuredSeries* measured = data.measured_series(sensor);
      const Window window = data.window_of(sensor);
      const auto arrival = measured == nullptr ? std::nullopt : arrival_at_fraction_of_peak(*measured, window);
      const auto seen =
          arrival && !ended_early(data, run) ? share_seen(run, sensor, {*arrival, window.end_s}) : std::nullopt;
      cells.push_back(number(scaled(seen, 100), 1));
    }
    table.add(std::move(cells));
  }
  table.notes.push_back(
      fmt::format("The probe reads zero where fluid fills less than {:g} of its kernel.", minimum_kernel_support));
  return table;
}

}  // namespace sluice
