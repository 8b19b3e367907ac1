// Figures of impulses: all runs beside the paper's, wall and sensor models, alpha.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures.h"
#include "reports/plot.h"
#include "reports/studies.h"
#include "reports/text.h"

namespace sluice {

namespace {

PlotCurve zero_line(double from, double to) {
  PlotCurve line;
  line.look = CurveLook::guide;
  line.x = {from, to};
  line.y = {0, 0};
  return line;
}

}  // namespace

namespace {

/// Deviations by sensor as points beside each other; `place` shifts one series so that points do not hide each other.
PlotCurve deviation_points(const ReportData& data, const AnalysedRun& run, const SensorReading& like, int style,
                           double place) {
  PlotCurve curve;
  curve.label = fmt::format("{} {}, read by {}", run.key, run.record.walls, like.model_name());
  curve.style = style;
  curve.points_only = true;
  double x = 1;
  for (const std::string& sensor : data.headline_sensors()) {
    const SensorReading* reading = run.find(sensor, like.model);
    const auto deviation = reading == nullptr ? std::nullopt : reading->comparison.impulse.deviation();
    if (deviation) {
      curve.x.push_back(x + place);
      curve.y.push_back(100 * *deviation);
    }
    ++x;
  }
  return curve;
}

void add_published_points(PlotPanel& panel, const ReportData& data, double alpha, double place) {
  PlotCurve curve;
  curve.label = fmt::format("paper's WCSPH, α = {}, l0 = 7.5 mm", shortest(alpha));
  curve.look = CurveLook::published;
  curve.points_only = true;
  for (const PublishedRun& run : data.the_case.published.runs)
    if (run.solver == "wcsph")
      curve.label = fmt::format("paper's WCSPH, α = {}, l0 = {:g} mm", shortest(alpha), 1000 * run.l0_m);
  double x = 1;
  for (const std::string& sensor : data.headline_sensors()) {
    if (const auto deviation = published_deviation(data, sensor, "wcsph", alpha)) {
      curve.x.push_back(x + place);
      curve.y.push_back(100 * *deviation);
    }
    ++x;
  }
  if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
}

PlotPanel wall_pair_panel(const ReportData& data, const AnalysedRun& first, const AnalysedRun& second) {
  const std::vector<std::string> sensors = data.headline_sensors();
  const auto last = static_cast<double>(sensors.size());
  PlotPanel panel;
  panel.title = fmt::format("{} and {}", first.short_label, second.key);
  panel.y_label = "deviation of impulse [%]";
  panel.x_ticks = sensors;
  panel.x_range = {0.5, last + 0.5};
  panel.curves.push_back(zero_line(0.5, last + 0.5));
  double place = -0.2;
  int style = 0;
  for (const AnalysedRun* run : {&first, &second})
    for (const SensorReading* reading : run->of(sensors.front())) {
      // With `dynamic` walls the wall's own pressure means nothing; its impulse would set the scale of the axis.
      if (reading->warning_only) continue;
      panel.curves.push_back(deviation_points(data, *run, *reading, style++, place));
      place += 0.1;
    }
  if (first.record.alpha()) add_published_points(panel, data, *first.record.alpha(), place);
  return panel;
}

}  // namespace

namespace {

/// Where a run or a published row stands on the axis of the overview.
struct Place {
  std::string tick;
  const AnalysedRun* run = nullptr;
  const PublishedImpulse* published = nullptr;
};

std::string run_tick(const AnalysedRun& run) {
  const RunRecord& r = run.record;
  return fmt::format("{} {}{}, {:g} mm", run.key, r.walls.empty() || !r.own ? r.solver : r.walls,
                     r.alpha() ? " α " + shortest(*r.alpha()) : "", 1000 * r.l0_m);
}

std::optional<double> overview_deviation(const ReportData& data, const Place& place, const std::string& sensor) {
  if (place.published != nullptr)
    return published_deviation(data, sensor, place.published->source, place.published->alpha);
  const SensorReading* reading = place.run->primary(sensor);
  return reading == nullptr ? std::nullopt : reading->comparison.impulse.deviation();
}

std::vector<Place> overview_places(const ReportData& data) {
  std::vector<Place> places;
  if (data.headline_sensors().empty()) return places;
  for (const PublishedImpulse& row : data.the_case.published.impulses)
    if (row.sensor == data.headline_sensors().front() && row.source != "experiment")
      places.push_back(
          {row.source == "mps" ? "paper MPS" : "paper α " + (row.alpha ? shortest(*row.alpha) : ""), nullptr, &row});
  const std::vector<std::string> sensors = data.headline_sensors();
  for (const AnalysedRun& run : data.runs) {
    const Place place{run_tick(run), &run, nullptr};
    if (std::any_of(sensors.begin(), sensors.end(),
                    [&](const std::string& sensor) { return overview_deviation(data, place, sensor).has_value(); }))
      places.push_back(place);
  }
  return places;
}

}  // namespace

std::vector<Picture> impulse_figures(const FigureMaker& maker) {
  const std::vector<Place> places = overview_places(maker.data);
  if (!maker.enabled || places.empty()) return {};
  PlotPanel panel;
  panel.y_label = "deviation of impulse [%]";
  const auto last = static_cast<double>(places.size());
  panel.x_range = {0.4, last + 0.6};
  panel.curves.push_back(zero_line(0.4, last + 0.6));
  for (const Place& place : places) panel.x_ticks.push_back(place.tick);
  panel.slanted_ticks = true;
  int style = 0;
  for (const std::string& sensor : maker.data.headline_sensors()) {
    PlotCurve curve;
    curve.label = sensor;
    curve.style = style++;
    curve.points_only = true;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const auto deviation = overview_deviation(maker.data, places[i], sensor)) {
        curve.x.push_back(static_cast<double>(i + 1) + 0.12 * (style - 2));
        curve.y.push_back(100 * *deviation);
      }
    panel.curves.push_back(std::move(curve));
  }
  PlotFigure figure;
  figure.name = "impulse_overview";
  figure.source = "primary readings";
  figure.panel_width_px = 960;
  figure.panels = {panel};
  return {draw_picture(
      maker, figure,
      "Signed deviation of the impulses, the paper's and the runs' (primary readings); zero is the measurement.",
      "Deviation of impulses from the measurement, paper and runs", true)};
}

std::vector<Picture> boundary_model_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  for (const auto& [first, second] : wall_pairs(maker.data)) {
    PlotFigure figure;
    figure.name = "walls_" + first->key + "_" + second->key;
    figure.source = first->label + ", " + second->label;
    figure.panels = {wall_pair_panel(maker.data, *first, *second)};
    pictures.push_back(draw_picture(
        maker, figure,
        fmt::format(
            "Deviation of the impulse by walls and by probe: {} against {}. The wall's own pressure with dynamic "
            "walls is left out of the picture (its numbers stand in the table).",
            first->label, second->key),
        "Deviation of the impulse at each sensor by wall model and sensor model"));
  }
  return pictures;
}

std::pair<double, double> alpha_range(const PlotPanel& panel) {
  double low = 1e300;
  double high = 0;
  for (const PlotCurve& curve : panel.curves)
    for (double alpha : curve.x) {
      low = std::min(low, alpha);
      high = std::max(high, alpha);
    }
  return {low / 1.6, high * 1.6};
}

PlotPanel alpha_panel(const ReportData& data, const std::string& sensor, const std::string& y_label,
                      const std::function<std::optional<double>(const Comparison&)>& measure) {
  PlotPanel panel;
  panel.x_label = "artificial viscosity α";
  panel.y_label = y_label;
  panel.log_x = true;
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
    }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

namespace {

/// Runs and paper, with the line of no deviation across; without curves where there is nothing to show.
PlotPanel impulse_alpha_panel(const ReportData& data, const std::string& sensor) {
  PlotPanel panel = alpha_panel(data, sensor, "deviation of impulse [%]",
                                [](const Comparison& c) { return scaled(c.impulse.deviation(), 100); });
  panel.title = sensor;
  PlotCurve paper;
  paper.label = "paper's WCSPH";
  paper.look = CurveLook::published;
  paper.every_point = true;
  for (const PublishedImpulse& row : data.the_case.published.impulses)
    if (row.sensor == sensor && row.source == "wcsph" && row.alpha) {
      paper.x.push_back(*row.alpha);
      paper.y.push_back(100 * published_deviation(data, sensor, "wcsph", row.alpha).value_or(NAN));
    }
  if (!paper.x.empty()) panel.curves.push_back(std::move(paper));
  if (panel.curves.empty()) return panel;
  panel.x_range = alpha_range(panel);
  panel.curves.push_back(zero_line(*panel.x_range.first, *panel.x_range.second));
  return panel;
}

}  // namespace

std::vector<Picture> alpha_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled || alpha_series(maker.data).empty()) return pictures;
  for (const std::string& sensor : maker.data.headline_sensors()) {
    PlotFigure figure;
    figure.name = "alpha_" + sensor;
    figure.source = "primary readings";
    figure.panels = {impulse_alpha_panel(maker.data, sensor)};
    if (figure.panels.front().curves.empty()) continue;
    pictures.push_back(draw_picture(
        maker, figure, fmt::format("Deviation of the impulse at {} against the artificial viscosity.", sensor),
        fmt::format("Deviation of the impulse at {} against alpha, runs and paper", sensor)));
  }
  return pictures;
}

}  // namespace sluice
