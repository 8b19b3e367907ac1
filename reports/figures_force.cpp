// Figures of forces alone: both routes to each, and what alpha does to it.
#include <fmt/format.h>

#include <cmath>

#include "reports/series_panels.h"
#include "reports/studies.h"

namespace sluice {
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

/// A series of one point shows nothing.
PlotPanel force_alpha_panel(const ReportData& data, const std::string& sensor, const std::string& y_label,
                            const std::function<std::optional<double>(const Comparison&)>& measure) {
  PlotPanel panel = alpha_panel(data, sensor, y_label, measure);
  panel.y_range = {0.0, std::nullopt};
  const auto range = alpha_range(panel);
  std::erase_if(panel.curves, [](const PlotCurve& curve) { return curve.x.size() < 2; });
  if (!panel.curves.empty()) panel.x_range = range;
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
        force_alpha_panel(maker.data, sensor, "peak after 10 ms mean [N]",
                          [](const Comparison& c) { return c.smoothed_peak.simulated; }),
        force_alpha_panel(maker.data, sensor, "noise [N]", [](const Comparison& c) { return c.noise.simulated; })};
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
