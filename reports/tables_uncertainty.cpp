// Tables over many comparisons: bias and scatter of each method, errors against uncertainties, and the best alpha of
// each quantity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/bias.h"
#include "reports/fitted_geometry.h"
#include "reports/quantity.h"
#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"
#include "validation/uncertainty.h"

namespace sluice {

namespace {

TableCell interval(const std::optional<Interval>& range, int decimals) {
  if (!range) return not_applicable("fewer than five pairs");
  return word(fmt::format("{} to {}", fixed(range->lower, decimals), fixed(range->upper, decimals)));
}

std::vector<TableCell> bias_row(const BiasMethod& method) {
  const auto found = bias_and_scatter(method.pairs);
  const TableCell pairs = number(static_cast<double>(usable_pairs(method.pairs)), 0);
  if (!found)
    return {word(method.name), pairs,           not_applicable("needs three pairs"), not_applicable(),
            not_applicable(),  not_applicable()};
  std::optional<Interval> scatter = found->scatter_interval;
  if (scatter) *scatter = {100 * scatter->lower, 100 * scatter->upper};
  const bool told = found->tells_bias();
  return {word(method.name),
          pairs,
          told ? number(found->bias, 2) : not_applicable("scatters too far"),
          told ? interval(found->bias_interval, 2) : not_applicable(),
          number(100 * found->scatter, 0),
          interval(scatter, 0)};
}

/// The heading of a series of which nothing can be said: without a measurement a table would be headings alone.
void drop_bare_heading(Table& table) {
  if (!table.rows.empty() && table.rows.back().is_group()) table.rows.pop_back();
}

}  // namespace

Table bias_table(const ReportData& data) {
  Table table;
  table.name = "bias_and_scatter";
  table.caption = "Bias and scatter of each method over all its comparisons with the experiment";
  table.columns = {{"Method", "method", false},
                   {"Pairs", "pairs"},
                   {"Bias", "bias"},
                   {"95 %", "bias_interval", false},
                   {"Scatter [%]", "scatter_percent"},
                   {"95 %", "scatter_interval", false}};
  for (const BiasQuantity& quantity : bias_quantities(data)) {
    table.add_group(quantity.name);
    for (const BiasMethod& method : quantity.methods) {
      table.add(bias_row(method));
      if (const std::size_t left_out = method.pairs.size() - usable_pairs(method.pairs); left_out > 0)
        table.notes.push_back(fmt::format("{}, {}: {} pair{} left out, a value in {} is not positive.", quantity.name,
                                          method.name, left_out, left_out == 1 ? "" : "s",
                                          left_out == 1 ? "it" : "them"));
    }
  }
  if (const std::string note = left_out_note(data); !note.empty()) table.notes.push_back(note);
  table.notes.push_back(
      "A pair is one sensor of one run, primary reading, coarse and fine runs alike; runs of other parameters than the "
      "case's are a method of their own. Bias 1.10: predictions are 10 % too large in the mean; scatter: relative "
      "standard deviation about that (the FDS validation guide's form, ratios taken as log-normal). The experiment's "
      "own uncertainty counts as none here, so that it is part of the scatter. Intervals by bootstrap over the pairs; "
      "pairs of one run are akin, and more so those of one sensor in several runs, which makes them too narrow: "
      "drawn by whole sensors they were 1.4 times as wide in one set of runs. The highest wave leaves out probes that "
      "stand in the reservoir: "
      "their maximum is its filling.");
  return table;
}

namespace {

/// What can be compared and converges: a value per resolution, with its measurement.
struct UncertainQuantity {
  std::string name;
  std::string sensor;
  bool is_peak = false;
};

std::vector<UncertainQuantity> uncertain_quantities(const ReportData& data) {
  std::vector<UncertainQuantity> out;
  for (const std::string& sensor : data.headline_sensors()) {
    const Quantity& q = quantity_of(data.the_case.find_sensor(sensor)->kind);
    out.push_back({fmt::format("{} impulse [{}]", sensor, q.impulse_unit), sensor, false});
    out.push_back({fmt::format("{} 10 ms mean peak [{}]", sensor, q.unit), sensor, true});
  }
  return out;
}

const Pair& values_of(const UncertainQuantity& quantity, const Comparison& c) {
  return quantity.is_peak ? c.smoothed_peak : c.impulse;
}

std::optional<double> numerical_uncertainty(const ReportData& data, const UncertainQuantity& quantity,
                                            const ResolutionSeries& series) {
  std::vector<ResolvedValue> results;
  for (const AnalysedRun* run : series.runs) {
    const SensorReading* reading = run->primary(quantity.sensor);
    if (reading == nullptr) continue;
    if (const auto value = values_of(quantity, reading->comparison).simulated)
      results.push_back({run->record.l0_m, *value});
  }
  if (results.size() < 3 || !differing_geometry(data, series).empty()) return std::nullopt;
  const double finest = results.back().value;
  return resolution_uncertainty(grid_convergence(std::move(results)), finest);
}

std::string conclusion(const ValidationUncertainty& v) {
  const auto within = v.within();
  if (!within) return "nothing known of the uncertainty";
  if (!v.complete())
    return *within ? "error not told from what is known of u_val" : "error larger than what is known of u_val";
  return *within ? "error within 2 u_val" : "error of the model";
}

void add_uncertainty_row(Table& table, const ReportData& data, const UncertainQuantity& quantity,
                         const ResolutionSeries& series) {
  const MeasuredSeries* measured = data.measured_series(quantity.sensor);
  if (measured == nullptr) return;
  const auto values_in = [&](const AnalysedRun* run) {
    const SensorReading* reading = run->primary(quantity.sensor);
    return reading == nullptr ? Pair{} : values_of(quantity, reading->comparison);
  };
  const auto finest = std::find_if(series.runs.rbegin(), series.runs.rend(),
                                   [&](const AnalysedRun* run) { return values_in(run).difference().has_value(); });
  if (finest == series.runs.rend()) return;
  const Pair values = values_in(*finest);
  const std::string name =
      finest == series.runs.rbegin() ? quantity.name : fmt::format("{}, {}", quantity.name, (*finest)->key);
  const Window window = data.window_of(quantity.sensor);
  ValidationUncertainty v;
  v.error = *values.difference();
  v.of_resolution = numerical_uncertainty(data, quantity, series);
  if (const CaseSensor* sensor = data.the_case.find_sensor(quantity.sensor); sensor->measured_is_band)
    v.of_measurement = quantity.is_peak ? peak_uncertainty(*measured, window) : impulse_uncertainty(*measured, window);
  table.add({word(name), rounded(values.simulated, 4), rounded(values.measured, 4), rounded(v.error, 3),
             rounded(v.of_resolution, 3), rounded(v.of_input, 3), rounded(v.of_measurement, 3), rounded(v.total(), 3),
             word(conclusion(v))});
}

}  // namespace

Table validation_uncertainty_table(const ReportData& data) {
  Table table;
  table.name = "validation_uncertainty";
  table.caption = "Comparison error against validation uncertainty (ASME V&V 20), finest run of each series";
  table.columns = {{"Quantity", "quantity", false},
                   {"Simulated S", "simulated"},
                   {"Measured D", "measured"},
                   {"E = S − D", "error"},
                   {"u_num", "u_num"},
                   {"u_input", "u_input"},
                   {"u_D", "u_D"},
                   {"u_val", "u_val"},
                   {"What follows", "conclusion", false}};
  for (const ResolutionSeries& series : resolution_series(data)) {
    table.add_group(series.title);
    for (const UncertainQuantity& quantity : uncertain_quantities(data))
      add_uncertainty_row(table, data, quantity, series);
    drop_bare_heading(table);
  }
  table.notes.push_back(
      "Standard uncertainties in the quantity's unit. u_num: grid convergence index over 1.15; missing where there are "
      "not three resolutions of one geometry in the asymptotic range. u_D: from the band of measured points where the "
      "case says that "
      "the measurement is one, each bin as wide as its points and all bins wrong the same way; missing for a single "
      "recording. u_input: no case states it. Where one is missing u_val is a lower bound. A quantity with a run's "
      "name is that run's: "
      "finer ones lack it.");
  return table;
}

namespace {

struct BestQuantity {
  std::string name;
  std::string sensor;
  std::optional<double> (*error)(const Comparison&);
};

std::optional<double> unsigned_of(std::optional<double> value) {
  if (value) *value = std::abs(*value);
  return value;
}

std::vector<BestQuantity> best_quantities(const ReportData& data) {
  std::vector<BestQuantity> out;
  for (const std::string& sensor : data.headline_sensors()) {
    out.push_back({sensor + " impulse", sensor,
                   [](const Comparison& c) { return unsigned_of(scaled(c.impulse.deviation(), 100)); }});
    out.push_back({sensor + " 10 ms mean peak", sensor,
                   [](const Comparison& c) { return unsigned_of(scaled(c.smoothed_peak.deviation(), 100)); }});
  }
  for (const std::string& sensor : data.sensors(SensorKind::wave_height))
    out.push_back(
        {sensor + " RMSE / range", sensor, [](const Comparison& c) { return scaled(c.rmse_over_range, 100); }});
  return out;
}

void add_best_row(Table& table, const AlphaSeries& series, const BestQuantity& quantity) {
  const AnalysedRun* best = nullptr;
  double least = 0;
  int compared = 0;
  std::string all;
  for (const AnalysedRun* run : series.runs) {
    const SensorReading* reading = run->primary(quantity.sensor);
    const auto error = reading == nullptr ? std::nullopt : quantity.error(reading->comparison);
    if (!error) continue;
    ++compared;
    all += fmt::format("{}{}: {}", all.empty() ? "" : ", ", shortest(*run->record.alpha()), fixed(*error, 1));
    if (best != nullptr && least <= *error) continue;
    best = run;
    least = *error;
  }
  if (compared < 2) return;  // the only one is not the best
  table.add({word(quantity.name), typed(best->record.alpha()),
             rounded(best->record.number("equivalent_viscosity_m2_s"), 2), number(least, 1), word(all)});
}

}  // namespace

Table best_alpha_table(const ReportData& data) {
  Table table;
  table.name = "best_alpha";
  table.caption = "The artificial viscosity with the smallest error, quantity by quantity, primary readings";
  table.columns = {{"Quantity", "quantity", false},
                   {"Best α", "alpha"},
                   {"Equivalent viscosity [m²/s]", "viscosity_m2_s"},
                   {"Error [%]", "error_percent"},
                   {"Error [%] at each α", "all_errors", false}};
  for (const AlphaSeries& series : alpha_series(data)) {
    table.add_group(series.title);
    for (const BestQuantity& quantity : best_quantities(data)) add_best_row(table, series, quantity);
    drop_bare_heading(table);
  }
  return table;
}

}  // namespace sluice
