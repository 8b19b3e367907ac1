// Figures of forces alone: both routes to each, and what alpha does to it.
#include <fmt/format.h>

#include <cmath>

#include "reports/series_panels.h"
#include "reports/studies.h"

namespace sluice {
namespace {

constexpr double smoothing_s = 0.01;

}  // namespace

std::vector<Picture> route_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  for (const CaseSensor& sensor : data.the_case.sensors) {
    if (sensor.kind != SensorKind::force) continue;
    std::vector<PlotPanel> panels;
    for (const AnalysedRun& run : data.runs) {
      if (run.of(sensor.name).size() < 2) continue;
      PlotPanel panel;
      panel.title = fmt::format("{}: {}", sensor.name, run.label);
      panel.x_label = "time [s]";
      panel.y_label = axis_name(sensor);
      panel.x_range = {data.window.begin_s, data.window.end_s};
      add_experiment(panel, data, sensor, data.window);
      int style = 0;
      for (const SensorReading* reading : run.of(sensor.name)) {
        panel.curves.push_back(run_curve(run, running_mean(reading->series, smoothing_s), data.window, style++, 1));
        panel.curves.back().label = reading->remarked_model();
      }
      panels.push_back(std::move(panel));
    }
    if (panels.empty()) continue;
    const std::string caption = fmt::format(
        "{} by both routes, after a 10 ms running mean: `acceleration` sums mass times acceleration of the "
        "wall's particles, `pressure` their pressures times area.",
        sensor.name);
    pictures.push_back(draw_series(maker, "force_routes_" + sensor.name, std::move(panels),
                                   with_remark(data, sensor, caption),
                                   fmt::format("{} over time by both routes, run by run", axis_name(sensor))));
  }
  return pictures;
}

namespace {

using Measure = std::optional<double> (*)(const Comparison&);

PlotPanel alpha_panel(const ReportData& data, const std::string& sensor, const std::string& y_label, Measure measure) {
  PlotPanel panel;
  panel.x_label = "artificial viscosity α";
  panel.y_label = y_label;
  panel.log_x = true;
  panel.y_range = {0.0, std::nullopt};
  double low = 1e300;
  double high = 0;
  int style = 0;
  for (const AlphaSeries& series : alpha_series(data)) {
    PlotCurve curve;
    curve.label = series.title;
    curve.style = style++;
    curve.every_point = true;
    for (const AnalysedRun* run : series.runs) {
      const SensorReading* reading = run->primary(sensor);
      const auto value = reading == nullptr ? std::nullopt : measure(reading->comparison);
      if (!value) continue;
      curve.x.push_back(*run->record.alpha());
      curve.y.push_back(*value);
      low = std::min(low, curve.x.back());
      high = std::max(high, curve.x.back());
    }
    if (curve.x.size() > 1) panel.curves.push_back(std::move(curve));
  }
  if (!panel.curves.empty()) panel.x_range = {low / 1.6, high * 1.6};
  return panel;
}

}  // namespace

std::vector<Picture> force_alpha_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled || alpha_series(maker.data).empty()) return pictures;
  for (const std::string& sensor : maker.data.sensors(SensorKind::force)) {
    PlotFigure figure;
    figure.name = "force_alpha_" + sensor;
    figure.source = "primary readings";
    figure.panels = {
        alpha_panel(maker.data, sensor, "peak after 10 ms mean [N]",
                    [](const Comparison& c) { return c.smoothed_peak.simulated; }),
        alpha_panel(maker.data, sensor, "noise [N]", [](const Comparison& c) { return c.noise.simulated; })};
    if (figure.panels.front().curves.empty()) continue;
    pictures.push_back(draw_picture(
        maker, figure,
        fmt::format("{}: its peak after a 10 ms running mean, and its noise (root mean square of what a 20 ms running "
                    "mean takes away), against the artificial viscosity.",
                    sensor),
        fmt::format("Peak and noise of the force {} against alpha", sensor)));
  }
  return pictures;
}

}  // namespace sluice
