// Tables of forces: peaks and times, impulses and errors, and what alpha does to them.
#include <fmt/format.h>

#include "reports/quantity.h"
#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {
namespace {

const int decimals = quantity_of(SensorKind::force).decimals;

/// Rows of one sensor: the experiment, then each run by both routes, one under the other.
template <class Experiment, class Run>
void add_sensor_rows(Table& table, const ReportData& data, const std::string& sensor, Experiment experiment, Run row) {
  table.add_group(sensor);
  if (const std::string remark = data.measured_remark(sensor); !remark.empty())
    table.notes.push_back(sensor + ": " + remark);
  const MeasuredSeries* measured = data.measured_series(sensor);
  std::vector<TableCell> cells = {word("Experiment", Tone::strong)};
  cells.resize(table.columns.size(), missing());
  if (measured != nullptr) cells = experiment(*measured);
  table.add(std::move(cells));
  for (const AnalysedRun& run : data.runs) {
    const auto readings = run.of(sensor);
    std::vector<TableCell> none = {word(run.label)};
    none.resize(table.columns.size(), missing());
    if (readings.empty()) table.add(std::move(none));
    for (const SensorReading* reading : readings) table.add(row(run, *reading));
  }
}

/// The comparison of any run with the measurement, for what it says of the measurement.
const Comparison* any_comparison(const ReportData& data, const std::string& sensor) {
  for (const AnalysedRun& run : data.runs)
    for (const SensorReading* reading : run.of(sensor))
      if (reading->comparison.peak.measured) return &reading->comparison;
  return nullptr;
}

std::vector<TableCell> measured_peaks(const Table& table, const Comparison* c) {
  const TableCell none = not_applicable();
  if (c == nullptr) {
    std::vector<TableCell> cells(table.columns.size(), missing());
    cells[0] = word("Experiment", Tone::strong);
    return cells;
  }
  return {word("Experiment", Tone::strong),
          none,
          number(c->peak.measured, decimals),
          number(c->peak_time_s.measured, 3),
          none,
          number(c->smoothed_peak.measured, decimals),
          number(c->smoothed_peak_time_s.measured, 3),
          none,
          number(c->arrival_s.measured, 3),
          none,
          number(c->half_peak_s.measured, 3),
          none};
}

}  // namespace

Table force_peaks_table(const ReportData& data) {
  Table table;
  table.name = "force_peaks";
  table.caption = "Forces: peak, arrival and rise, by both routes";
  table.columns = {{"Force and run", "run", false},
                   {"Route", "route", false},
                   {"Peak [N]", "peak_N"},
                   {"at [s]", "peak_time_s"},
                   {"off by [%]", "peak_deviation_percent"},
                   {"10 ms mean peak [N]", "smoothed_peak_N"},
                   {"at [s]", "smoothed_peak_time_s"},
                   {"off by [%]", "smoothed_peak_deviation_percent"},
                   {"Arrival [s]", "arrival_s"},
                   {"later by [ms]", "arrival_difference_ms"},
                   {"Half peak [s]", "half_peak_s"},
                   {"later by [ms]", "half_peak_difference_ms"}};
  for (const std::string& sensor : data.sensors(SensorKind::force))
    add_sensor_rows(
        table, data, sensor, [&](const MeasuredSeries&) { return measured_peaks(table, any_comparison(data, sensor)); },
        [&](const AnalysedRun& run, const SensorReading& reading) -> std::vector<TableCell> {
          const Comparison& c = reading.comparison;
          return {word(run.label),
                  word(reading.remarked_model()),
                  number(c.peak.simulated, decimals),
                  number(c.peak_time_s.simulated, 3),
                  signed_number(scaled(c.peak.deviation(), 100), 1),
                  number(c.smoothed_peak.simulated, decimals),
                  number(c.smoothed_peak_time_s.simulated, 3),
                  signed_number(scaled(c.smoothed_peak.deviation(), 100), 1),
                  number(c.arrival_s.simulated, 3),
                  signed_number(scaled(c.arrival_s.difference(), 1000), 0),
                  number(c.half_peak_s.simulated, 3),
                  signed_number(scaled(c.half_peak_s.difference(), 1000), 0)};
        });
  table.notes.push_back(
      "Arrival and half peak: first time at 10 % and at half of the measured peak, in both series; where nothing was "
      "measured, of the run's own peak. Peaks are raw, and after a 10 ms running mean of both series: the first touch "
      "of "
      "a weakly compressible front is a spike whose height is a matter of sampling.");
  return table;
}

namespace {

/// The window of the sensor's comparison, then the spans that the case names beside it.
std::vector<Window> impulse_windows(const ReportData& data, const CaseSensor& sensor) {
  std::vector<Window> windows{data.window_of(sensor.name)};
  for (const TimeWindow& span : sensor.impulses_s) windows.push_back({span.start_s, span.end_s});
  return windows;
}

std::string span_words(Window window) {
  return fmt::format("{} … {} s", shortest(window.begin_s), shortest(window.end_s));
}

std::vector<TableColumn> impulse_columns(const std::vector<Window>& windows) {
  std::vector<TableColumn> columns = {{"Run", "run", false}, {"Route", "route", false}};
  for (const Window& window : windows) {
    const std::string name = fmt::format("impulse_{:g}_{:g}_s", window.begin_s, window.end_s);
    columns.push_back({fmt::format("Impulse {} [N s]", span_words(window)), name + "_N_s"});
    columns.push_back({"off by [%]", name + "_deviation_percent"});
  }
  columns.insert(columns.end(), {{"RMSE [N]", "rmse_N"},
                                 {"RMSE / range [%]", "rmse_over_range_percent"},
                                 {"Inside band [%]", "inside_band_percent"},
                                 {"Best lag [ms]", "best_lag_ms"},
                                 {"Correlation", "correlation"},
                                 {"Noise [N]", "noise_N"}});
  return columns;
}

std::vector<TableCell> impulse_row(const ReportData& data, const AnalysedRun& run, const SensorReading& reading,
                                   const std::vector<Window>& windows) {
  const MeasuredSeries* measured = data.measured_series(reading.sensor);
  std::vector<TableCell> cells = {word(run.label), word(reading.remarked_model())};
  for (const Window& window : windows) {
    const auto simulated = reading.series.t_s.empty() ? std::nullopt : impulse(reading.series, window);
    const auto known = measured == nullptr ? std::nullopt : impulse(*measured, window);
    cells.push_back(number(simulated, 3));
    cells.push_back(signed_number(scaled(relative_deviation(simulated, known), 100), 1));
  }
  const Comparison& c = reading.comparison;
  cells.insert(cells.end(), {number(c.rmse, decimals), number(scaled(c.rmse_over_range, 100), 1),
                             inside_band(data, reading), signed_number(scaled(c.lag_s, 1000), 0),
                             number(c.correlation, 2), number(c.noise.simulated, decimals)});
  return cells;
}

}  // namespace

Table force_impulses_table(const ReportData& data, const std::string& sensor) {
  const CaseSensor& of = *data.the_case.find_sensor(sensor);
  const std::vector<Window> windows = impulse_windows(data, of);
  Table table;
  table.name = "force_impulses_" + sensor;
  table.caption = fmt::format("{}: impulses and errors over {}, by both routes", sensor, span_words(windows.front()));
  table.columns = impulse_columns(windows);
  add_sensor_rows(
      table, data, sensor,
      [&](const MeasuredSeries& measured) {
        std::vector<TableCell> cells = {word("Experiment", Tone::strong), not_applicable()};
        for (const Window& window : windows) {
          cells.push_back(number(impulse(measured, window), 3));
          cells.push_back(not_applicable());
        }
        cells.resize(table.columns.size(), not_applicable());
        return cells;
      },
      [&](const AnalysedRun& run, const SensorReading& reading) { return impulse_row(data, run, reading, windows); });
  table.notes.push_back(
      of.measured_is_band || data.measured_series(sensor) == nullptr
          ? "Inside band: share of the time between the lowest and the highest measured point of a "
            "bin; the points of several runs or lines are the band. Bins without points count neither "
            "way. Noise: root mean square of what a 20 ms running mean takes away."
          : "Inside band: a dash, since the measurement is no band. Noise: root mean square of what a "
            "20 ms running mean takes away.");
  return table;
}

Table force_alpha_table(const ReportData& data) {
  Table table;
  table.name = "force_alpha";
  table.caption = "Forces against the artificial viscosity, primary readings";
  table.columns = {{"Run", "run", false},
                   {"α", "alpha"},
                   {"10 ms mean peak [N]", "smoothed_peak_N"},
                   {"Impulse [N s]", "impulse_N_s"},
                   {"Noise [N]", "noise_N"},
                   {"RMSE / range [%]", "rmse_over_range_percent"}};
  for (const std::string& sensor : data.sensors(SensorKind::force))
    for (const AlphaSeries& series : alpha_series(data)) {
      table.add_group(sensor + ": " + series.title);
      for (const AnalysedRun* run : series.runs) {
        const SensorReading* reading = run->primary(sensor);
        const Comparison c = reading == nullptr ? Comparison{} : reading->comparison;
        table.add({word(run->label), typed(run->record.alpha()), number(c.smoothed_peak.simulated, decimals),
                   number(c.impulse.simulated, 3), number(c.noise.simulated, decimals),
                   number(scaled(c.rmse_over_range, 100), 1)});
      }
    }
  return table;
}

}  // namespace sluice
