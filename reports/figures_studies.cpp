// Figures of errors against resolution and against cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures.h"
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

/// Points that fall on each other share one label.
void merge_labels(PlotPanel& panel, double largest_y) {
  struct Label {
    double x = 0, y = 0;
    std::string* text = nullptr;
  };
  std::vector<Label> kept;
  for (PlotCurve& curve : panel.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const auto close = [&](const Label& l) {
        return std::abs(std::log(curve.x[i] / l.x)) < 0.3 && std::abs(curve.y[i] - l.y) < 0.06 * largest_y;
      };
      const auto found = std::find_if(kept.begin(), kept.end(), close);
      if (found == kept.end()) {
        kept.push_back({curve.x[i], curve.y[i], &curve.point_labels[i]});
        continue;
      }
      *found->text += ", " + curve.point_labels[i];
      curve.point_labels[i].clear();
    }
}

/// A point a run; runs that lack one of the two are named in left_out.
struct CostPoints {
  PlotPanel panel;
  std::size_t points = 0;
  double largest = 0;
  std::string left_out;
};

CostPoints cost_points(const ReportData& data) {
  CostPoints out;
  out.panel.x_label = "processor time of the run [min]";
  out.panel.y_label = "mean deviation of impulses [%]";
  out.panel.log_x = true;
  out.panel.y_range = {0.0, std::nullopt};
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
      curve.point_labels.push_back(run->key);
      out.largest = std::max(out.largest, curve.y.back());
    }
    out.points += curve.x.size();
    if (!curve.x.empty()) out.panel.curves.push_back(std::move(curve));
  }
  return out;
}

}  // namespace

std::vector<Picture> cost_figures(const FigureMaker& maker) {
  if (!maker.enabled) return {};
  CostPoints cost = cost_points(maker.data);
  if (cost.points < 2) return {};
  merge_labels(cost.panel, cost.largest);
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
