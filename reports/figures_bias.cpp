// Predicted against measured, every sensor of every run.
#include <fmt/format.h>

#include <algorithm>

#include "reports/bias.h"
#include "reports/figures.h"

namespace sluice {

namespace {

/// Both axes alike, so that agreement is the diagonal.
PlotPanel bias_panel(const BiasQuantity& quantity) {
  PlotPanel panel;
  panel.title = quantity.name;
  panel.x_label = fmt::format("measured [{}]", quantity.unit);
  panel.y_label = fmt::format("predicted [{}]", quantity.unit);
  std::optional<double> least;
  std::optional<double> most;
  int style = 0;
  for (const BiasMethod& method : quantity.methods) {
    PlotCurve curve;
    curve.label = method.name;
    curve.style = style++;
    curve.points_only = true;
    for (const PredictedAndMeasured& pair : method.pairs) {
      if (pair.predicted <= 0 || pair.measured <= 0) continue;
      curve.x.push_back(pair.measured);
      curve.y.push_back(pair.predicted);
      least = std::min({least.value_or(pair.measured), pair.measured, pair.predicted});
      most = std::max({most.value_or(pair.measured), pair.measured, pair.predicted});
    }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  if (!least) return panel;
  panel.log_x = panel.log_y = *most > 10 * *least;
  const std::pair<double, double> range{*least / 1.3, *most * 1.3};
  panel.x_range = panel.y_range = {range.first, range.second};
  for (const double factor : {0.8, 1.0, 1.25}) {
    PlotCurve line;
    line.look = CurveLook::guide;
    line.x = {range.first, range.second};
    line.y = {factor * range.first, factor * range.second};
    panel.curves.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

std::vector<Picture> bias_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  PlotFigure figure;
  figure.name = "predicted_and_measured";
  figure.source = "primary readings of all runs";
  figure.columns = 2;
  figure.panel_width_px = 480;
  figure.panel_height_px = 420;
  for (const BiasQuantity& quantity : bias_quantities(maker.data))
    if (PlotPanel panel = bias_panel(quantity); !panel.curves.empty()) figure.panels.push_back(std::move(panel));
  if (figure.panels.empty()) return pictures;
  pictures.push_back(
      draw_picture(maker, figure,
                   "Predicted against measured, a point for each sensor of each run. Grey lines: agreement, "
                   "a quarter too much, a fifth too little.",
                   "Predicted against measured values"));
  return pictures;
}

}  // namespace sluice
