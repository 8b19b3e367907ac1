// Tables across runs: wall models and sensor models, artificial viscosity, resolution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "reports/fitted_geometry.h"
#include "reports/quantity.h"
#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"
#include "validation/convergence.h"

namespace sluice {

namespace {

std::optional<double> impulse_deviation(const SensorReading* reading) {
  return reading == nullptr ? std::nullopt : reading->comparison.impulse.deviation();
}

void add_published_deviations(Table& table, const ReportData& data, double alpha) {
  const std::vector<std::string> sensors = data.headline_sensors();
  std::vector<TableCell> cells = {word("Paper: WCSPH"), word("dynamic"), word("kernel"), typed(alpha)};
  double sum = 0;
  for (const std::string& sensor : sensors) {
    const auto deviation = published_deviation(data, sensor, "wcsph", alpha);
    if (!deviation) return;
    sum += std::abs(*deviation);
    cells.push_back(signed_number(100 * *deviation, 1));
  }
  cells.push_back(number(100 * sum / static_cast<double>(sensors.size()), 1));
  table.add(std::move(cells));
}

}  // namespace

Table boundary_models_table(const ReportData& data) {
  Table table;
  table.name = "boundary_and_sensor_models";
  table.caption = "Signed deviation of the impulse by wall model and sensor model, runs alike in all else [%]";
  table.columns = {{"Run", "run", false}, {"Walls", "walls", false}, {"Sensor model", "model", false}, {"α", "alpha"}};
  const std::vector<std::string> sensors = data.headline_sensors();
  for (const std::string& sensor : sensors) table.columns.push_back({sensor + " [%]", sensor + "_percent"});
  table.columns.push_back({"Mean of |…| [%]", "mean_unsigned_percent"});
  for (const auto& [first, second] : wall_pairs(data)) {
    table.add_group(fmt::format("{} against {}", first->label, second->key));
    for (const AnalysedRun* run : {first, second})
      for (const SensorReading* reading : run->of(sensors.front())) {
        std::vector<TableCell> cells = {word(run->label), word(run->record.walls), word(reading->remarked_model()),
                                        typed(run->record.alpha())};
        for (const std::string& sensor : sensors)
          cells.push_back(signed_number(scaled(impulse_deviation(run->find(sensor, reading->model)), 100), 1));
        cells.push_back(number(scaled(mean_impulse_error(data, *run, reading->model), 100), 1));
        table.add(std::move(cells));
      }
    if (first->record.alpha()) add_published_deviations(table, data, *first->record.alpha());
  }
  return table;
}

Table alpha_table(const ReportData& data) {
  Table table;
  table.name = "alpha";
  table.caption = "Signed deviation of the impulse against the artificial viscosity, primary readings [%]";
  table.columns = {{"Series", "series", false}, {"α", "alpha"}};
  const std::vector<std::string> sensors = data.headline_sensors();
  for (const std::string& sensor : sensors) table.columns.push_back({sensor + " [%]", sensor + "_percent"});
  table.columns.push_back({"Mean of |…| [%]", "mean_unsigned_percent"});
  for (const AlphaSeries& series : alpha_series(data)) {
    table.add_group(series.title);
    for (const AnalysedRun* run : series.runs) {
      std::vector<TableCell> cells = {word(run->label), typed(run->record.alpha())};
      for (const std::string& sensor : sensors)
        cells.push_back(signed_number(scaled(impulse_deviation(run->primary(sensor)), 100), 1));
      cells.push_back(number(scaled(mean_impulse_error(data, *run), 100), 1));
      table.add(std::move(cells));
    }
  }
  return table;
}

namespace {

TableCell convergence_cell(const std::vector<ResolutionPoint>& points, bool same_geometry) {
  if (points.size() < 3) return not_applicable("needs three resolutions");
  if (!same_geometry) return word("none: geometries differ");
  std::vector<ResolvedValue> results;
  for (const ResolutionPoint& point : points) results.push_back({point.l0_m, point.value});
  const GridConvergence c = grid_convergence(std::move(results));
  if (!c.asymptotic || !c.order) return word(std::string(c.verdict()));
  std::string text = "order " + fixed(*c.order, 1);
  if (c.index) text += fmt::format(", grid convergence index {} %", fixed(100 * *c.index, 1));
  return word(text);
}

/// Coarsest first.
std::set<double, std::greater<>> particle_distances(const std::vector<ResolutionSeries>& all_series) {
  std::set<double, std::greater<>> distances;
  for (const ResolutionSeries& series : all_series)
    for (const AnalysedRun* run : series.runs) distances.insert(run->record.l0_m);
  return distances;
}

}  // namespace

Table resolution_table(const ReportData& data) {
  Table table;
  table.name = "resolution";
  table.caption = fmt::format("{} against the particle distance, primary readings unless another sensor model is named",
                              data.has(SensorKind::force) ? "Errors and forces" : "Errors");
  table.columns = {{"Quantity", "quantity", false}};
  const std::vector<ResolutionSeries> all_series = resolution_series(data);
  const std::set<double, std::greater<>> distances = particle_distances(all_series);
  for (double l0 : distances)
    table.columns.push_back({fmt::format("l0 = {:g} mm", 1000 * l0), fmt::format("l0_{:g}_mm", 1000 * l0)});
  table.columns.push_back({"Observed order of the value", "observed_order", false});
  for (const ResolutionSeries& series : all_series) {
    table.add_group(series.title);
    const std::string geometry = differing_geometry(data, series);
    if (!geometry.empty() && series.runs.size() > 2)
      table.notes.push_back(fmt::format(
          "{}: no order, since the lattice changes the geometry as well from one particle distance to the next: {}.",
          series.title, geometry));
    for (const ResolutionQuantity& quantity : resolution_quantities(data, series)) {
      std::vector<TableCell> cells = {word(quantity.name)};
      for (double l0 : distances) {
        const auto found = std::find_if(quantity.points.begin(), quantity.points.end(),
                                        [&](const ResolutionPoint& p) { return p.l0_m == l0; });
        cells.push_back(found == quantity.points.end() ? missing()
                        : quantity.shows_value         ? number(found->value, quantity.decimals)
                                                       : signed_number(found->error, quantity.decimals));
      }
      cells.push_back(convergence_cell(quantity.points, geometry.empty()));
      table.add(std::move(cells));
    }
  }
  table.notes.push_back(
      "Index: safety factor 1.25 where the observed order lies between 1.8 and 2.2, else 3, with an order of 2 at "
      "most.");
  if (const std::string note = left_out_note(data); !note.empty()) table.notes.push_back(note);
  for (const ResolutionSeries& series : all_series)
    for (const AnalysedRun* run : series.left_out)
      table.notes.push_back(
          fmt::format("{} is left out: another run at its particle distance stands for both.", run->key));
  return table;
}

Table placements_table(const ReportData& data) {
  Table table;
  table.name = "placements";
  table.caption = "What lengths that the case's sources leave open do to the result, primary readings";
  table.columns = {{"Run", "run", false}, {"Length", "length", false}, {"[m]", "length_m"}};
  const std::vector<std::string> sensors = data.headline_sensors();
  for (const std::string& sensor : sensors) {
    const Quantity& q = quantity_of(data.the_case.find_sensor(sensor)->kind);
    table.columns.push_back({sensor + " arrival [s]", sensor + "_arrival_s"});
    table.columns.push_back({fmt::format("{} 10 ms mean peak [{}]", sensor, q.unit), sensor + "_smoothed_peak"});
    table.columns.push_back({fmt::format("{} impulse [{}]", sensor, q.impulse_unit), sensor + "_impulse"});
  }
  for (const PlacementSeries& series : placement_series(data)) {
    table.add_group(series.title);
    for (const AnalysedRun* run : series.runs) {
      const double at_m = placed_at_m(*data.the_case.find_placement(series.placement), run->record);
      std::vector<TableCell> cells = {word(run->label), word(series.placement), typed(at_m)};
      for (const std::string& sensor : sensors) {
        const SensorReading* reading = run->primary(sensor);
        const Comparison c = reading == nullptr ? Comparison{} : reading->comparison;
        const int decimals = quantity_of(data.the_case.find_sensor(sensor)->kind).decimals;
        cells.push_back(number(c.arrival_s.simulated, 3));
        cells.push_back(number(c.smoothed_peak.simulated, decimals));
        cells.push_back(number(c.impulse.simulated, decimals));
      }
      table.add(std::move(cells));
    }
  }
  return table;
}

}  // namespace sluice
