// The report's figures, each drawn from the analysed runs into the report's folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/analysis.h"
#include "reports/document.h"
#include "reports/plot.h"

namespace sluice {

/// Where figures go and what they are drawn from.
struct FigureMaker {
  const ReportData& data;
  std::filesystem::path report_folder;  ///< figures/ below it
  bool enabled = true;                  ///< false: no picture is drawn, every list comes back empty
};

/// Draws a figure into figures/ and returns it as the document's block. Throws as draw().
Picture draw_picture(const FigureMaker& maker, const PlotFigure& figure, const std::string& caption,
                     const std::string& description, bool wide = false);

/// Curves of runs in one panel: more cannot be told apart.
inline constexpr std::size_t runs_a_panel = 5;
/// A run's series over a window, times `unit`, thinned for drawing.
PlotCurve run_curve(const AnalysedRun& run, const Series& series, Window window, int style, double unit);

/// The whole window, one panel a group of runs: pressures and forces after a 10 ms running mean unless `raw`, wave
/// heights and velocities as they are.
std::vector<Picture> series_figures(const FigureMaker& maker, SensorKind kind, bool raw = false);
/// The same over the whole window with both methods in each panel, for sensors of which the paper has such a figure.
std::vector<Picture> method_figures(const FigureMaker& maker, SensorKind kind);
/// The same with runs of other codes beside the references (beside_references()), for every sensor.
std::vector<Picture> other_code_figures(const FigureMaker& maker, SensorKind kind);
/// The same wave heights as read by model `top`, where that is not the primary reading.
std::vector<Picture> spray_figures(const FigureMaker& maker);
/// The first impact on each sensor of a kind, raw.
std::vector<Picture> impact_figures(const FigureMaker& maker, SensorKind kind);
/// Each force of each run by both routes.
std::vector<Picture> route_figures(const FigureMaker& maker);
/// The case's boxes at the start in plan and elevation, with their lengths.
std::vector<Picture> geometry_figures(const FigureMaker& maker);

/// The faces of bodies with two pressure sensors or more, each sensor by its name.
std::vector<Picture> sensor_face_figures(const FigureMaker& maker);

/// One curve for each series of runs that differ in alpha alone: what `measure` says of the sensor's primary reading.
PlotPanel alpha_panel(const ReportData& data, const std::string& sensor, const std::string& y_label,
                      const std::function<std::optional<double>(const Comparison&)>& measure);
/// The alphas in a panel, and a little more on both sides.
std::pair<double, double> alpha_range(const PlotPanel& panel);

/// Impulse deviations of every run beside the paper's, at the headline sensors.
std::vector<Picture> impulse_figures(const FigureMaker& maker);
std::vector<Picture> boundary_model_figures(const FigureMaker& maker);
std::vector<Picture> alpha_figures(const FigureMaker& maker);
/// Peak, impulse and noise of each force against alpha.
std::vector<Picture> force_alpha_figures(const FigureMaker& maker);
std::vector<Picture> resolution_figures(const FigureMaker& maker);
/// Predicted against measured, one panel a quantity.
std::vector<Picture> bias_figures(const FigureMaker& maker);
std::vector<Picture> cost_figures(const FigureMaker& maker);
/// Energy of the fluid and its densest particle over time, one picture a group of runs.
std::vector<Picture> conservation_figures(const FigureMaker& maker);

/// Particles coloured by dimensionless pressure or velocity, as the case asks, one picture a run that kept snapshots.
std::vector<Picture> snapshot_figures(const FigureMaker& maker);

}  // namespace sluice
