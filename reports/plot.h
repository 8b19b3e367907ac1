// Line figures: what a picture shows, apart from how gnuplot draws it. Each figure becomes NAME.gp, NAME.dat and
// NAME.svg in one folder; `gnuplot NAME.gp` there draws it again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sluice {

enum class CurveLook {
  run,         ///< colour, dashes and marker by the curve's `style`
  experiment,  ///< thick black line
  published,   ///< grey, open markers
  guide,       ///< thin grey dashes without a legend entry
  leader       ///< thin grey line from a point to its name, likewise
};

struct PlotCurve {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  CurveLook look = CurveLook::run;
  int style = 0;  ///< index into the palette (colour, dashes and marker together)
  bool points_only = false;
  bool every_point = false;               ///< a marker at every point; otherwise a few along the line
  std::vector<std::string> point_labels;  ///< one a point, or none
};

/// A word centred at a place.
struct PlotName {
  std::string text;
  double x = 0;
  double y = 0;
};

/// A shaded area between two curves.
struct PlotBand {
  std::string label;
  std::vector<double> x;
  std::vector<double> lower;
  std::vector<double> upper;
};

using PlotRange = std::pair<std::optional<double>, std::optional<double>>;

struct PlotPanel {
  std::string title;
  std::string x_label;
  std::string y_label;
  PlotRange x_range;
  PlotRange y_range;
  bool log_x = false;
  bool log_y = false;
  std::vector<std::string> x_ticks;  ///< words under x = 1, 2, ... in place of numbers
  bool slanted_ticks = false;        ///< long words: written at an angle
  std::vector<PlotBand> bands;
  std::vector<PlotCurve> curves;
  std::vector<PlotName> names;
  bool equal_scale = false;  ///< a length is as long across as it is up: for drawings of bodies
};

struct PlotFigure {
  std::string name;
  std::vector<PlotPanel> panels;
  int columns = 1;            ///< panels side by side
  int panel_width_px = 664;   ///< two legend entries of 29 characters have room beside each other
  int panel_height_px = 320;  ///< without the legend and slanted words below, for which room is added
  std::string source;         ///< a comment in the script: which runs, which commit
};

/// Writes the figure's files into `folder` (made when missing) and runs gnuplot. Returns the picture's path.
/// A point that is not finite is left out, and interrupts its curve. Throws as run_gnuplot().
std::filesystem::path draw(const PlotFigure& figure, const std::filesystem::path& folder);

/// For drawing a long series in `columns` pixel columns: each column keeps its smallest and largest sample at their own
/// times, so that no peak is lost.
std::pair<std::vector<double>, std::vector<double>> thin_out(const std::vector<double>& x, const std::vector<double>& y,
                                                             double x_begin, double x_end, int columns);

}  // namespace sluice
