// Figures of errors against resolution and against cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/figures.h"
#include "reports/name_places.h"
#include "reports/plot.h"
#include "reports/studies.h"

namespace sluice {

namespace {

std::string runs_label(const std::vector<const AnalysedRun*>& runs) {
  std::string out;
  for (const AnalysedRun* run : runs) out += (out.empty() ? "" : ", ") + run->label;
  return out;
}

}  // namespace

namespace {

/// Markers at the finest and at the coarsest distance stand inside the axes.
PlotRange with_margin(const ResolutionSeries& series) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const AnalysedRun* run : series.runs) {
    least = std::min(least, 1000 * run->record.l0_m);
    most = std::max(most, 1000 * run->record.l0_m);
  }
  const double margin = 0.04 * (most - least);
  return {least - margin, most + margin};
}

/// Curves of errors or of values; their unit is cut off an error's name, for the axis has it.
PlotPanel resolution_panel(const ReportData& data, const ResolutionSeries& series, bool values) {
  PlotPanel panel;
  panel.title = series.title;
  panel.x_label = "particle distance l0 [mm]";
  panel.y_label = values ? "value, in the unit named below" : "error, unsigned [%]";
  panel.y_range = {0.0, std::nullopt};
  int style = 0;
  for (const ResolutionQuantity& quantity : resolution_quantities(data, series)) {
    const bool percent = quantity.name.ends_with("[%]");
    if (quantity.shows_value != values || (!values && !percent) || !quantity.model.empty()) continue;
    PlotCurve curve;
    curve.label = values ? quantity.name : quantity.name.substr(0, quantity.name.size() - 4);
    curve.style = style++;
    curve.every_point = true;
    for (const ResolutionPoint& point : quantity.points) {
      curve.x.push_back(1000 * point.l0_m);
      curve.y.push_back(values ? point.value : std::abs(point.error));
    }
    panel.curves.push_back(std::move(curve));
  }
  panel.x_range = with_margin(series);
  return panel;
}

}  // namespace

std::vector<Picture> resolution_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  int index = 0;
  for (const ResolutionSeries& series : resolution_series(maker.data)) {
    PlotFigure figure;
    figure.name = fmt::format("resolution_{}", ++index);
    figure.source = runs_label(series.runs);
    for (const bool values : {false, true}) {
      PlotPanel panel = resolution_panel(maker.data, series, values);
      if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
    }
    if (figure.panels.empty()) continue;
    const char* what = maker.data.has(SensorKind::force) ? "Forces and errors" : "Errors";
    pictures.push_back(draw_picture(maker, figure,
                                    fmt::format("{} against the particle distance, {}.", what, series.title),
                                    fmt::format("{} against the particle distance", what)));
  }
  return pictures;
}

namespace {

// Of the picture, where the axes are drawn: near enough to tell what would cover what.
constexpr PlacePx axes_px{555, 222};

/// Ranges that hold all points and leave room for names, which are put where none covers another.
void name_points(PlotPanel& panel, const std::vector<std::string>& names) {
  std::vector<std::pair<double, double>> points;
  for (const PlotCurve& curve : panel.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) points.emplace_back(curve.x[i], curve.y[i]);
  const auto [least, most] = std::minmax_element(points.begin(), points.end());
  const double begin = least->first / 2;
  const double end = 2 * most->first;
  const double decades = std::log10(end / begin);
  double top = 0.1;  // an axis needs a length where all errors are zero
  for (const auto& [x, y] : points) top = std::max(top, 1.1 * y);
  panel.x_range = {begin, end};
  panel.y_range = {0.0, top};
  std::vector<NamedPoint> named;
  for (std::size_t i = 0; i < points.size(); ++i)
    named.push_back(
        {{axes_px.x * std::log10(points[i].first / begin) / decades, axes_px.y * points[i].second / top}, names[i]});
  const auto x_of = [&](PlacePx px) { return begin * std::pow(10, decades * px.x / axes_px.x); };
  const auto y_of = [&](PlacePx px) { return top * px.y / axes_px.y; };
  const std::vector<NamePlace> places = place_names(named, axes_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NamePlace& place = places[i];
    panel.names.push_back({names[i], x_of(place.centre), y_of(place.centre)});
    if (!place.apart) continue;
    PlotCurve line;
    line.look = CurveLook::leader;
    line.x = {points[i].first, x_of(place.line_end)};
    line.y = {points[i].second, y_of(place.line_end)};
    panel.curves.push_back(std::move(line));
  }
}

/// A point a run; runs that lack one of the two are named in left_out.
struct CostPoints {
  PlotPanel panel;
  std::vector<std::string> names;
  std::string left_out;
};

CostPoints cost_points(const ReportData& data) {
  CostPoints out;
  out.panel.x_label = "processor time of the run [min]";
  out.panel.y_label = "mean deviation of impulses [%]";
  out.panel.log_x = true;
  int style = 0;
  for (const RunGroup& group : run_groups(data, data.runs.size())) {
    PlotCurve curve;
    curve.label = group.title;
    curve.style = style++;
    curve.points_only = true;
    for (const AnalysedRun* run : group.runs) {
      const auto error = mean_impulse_error(data, *run);
      const auto seconds = processor_time_s(*run);
      if (!error || !seconds || *seconds <= 0) {
        out.left_out += (out.left_out.empty() ? "" : ", ") + run->key;
        continue;
      }
      curve.x.push_back(*seconds / 60);
      curve.y.push_back(100 * *error);
      out.names.push_back(run->key);
    }
    if (!curve.x.empty()) out.panel.curves.push_back(std::move(curve));
  }
  return out;
}

}  // namespace

std::vector<Picture> cost_figures(const FigureMaker& maker) {
  if (!maker.enabled) return {};
  CostPoints cost = cost_points(maker.data);
  if (cost.names.size() < 2) return {};
  name_points(cost.panel, cost.names);
  PlotFigure figure;
  figure.name = "error_and_cost";
  figure.source = "primary readings";
  figure.panels = {cost.panel};
  std::string caption =
      "Error against cost: down and to the left is better. Processor times, summed over threads, hold for the machines "
      "named under Provenance.";
  if (!cost.left_out.empty())
    caption += fmt::format(" Not drawn, for want of a processor time or of an error of impulses: {}.", cost.left_out);
  return {draw_picture(maker, figure, caption, "Mean deviation of impulses against processor time, one point a run")};
}

}  // namespace sluice
