#include "reports/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "reports/gnuplot.h"
#include "reports/plot_room.h"
#include "reports/text.h"
#include "validation/printable.h"

namespace sluice {

namespace {

/// Colours of Okabe and Ito (2008), told apart with every common colour blindness; the pale yellow is left out, since
/// it does not show on paper. Dashes and markers tell the curves apart in black and white.
struct Look {
  const char* colour;
  const char* dashes;
  int marker;
};
constexpr std::array<Look, 6> looks = {{{"#0072B2", "solid", 7},
                                        {"#D55E00", "(12,5)", 5},
                                        {"#009E73", "(3,4)", 9},
                                        {"#CC79A7", "(14,4,3,4)", 13},
                                        {"#E69F00", "(8,3)", 11},
                                        {"#56B4E9", "(14,4,3,4,3,4)", 4}}};
constexpr std::array<int, looks.size()> more_markers{6, 4, 8, 12, 10, 2};

std::string line_style(const PlotCurve& curve) {
  const auto style = static_cast<std::size_t>(curve.style);
  Look look = looks[style % looks.size()];
  // A seventh curve has the first one's colour and a marker of its own.
  if (style / looks.size() % 2 == 1) look.marker = more_markers[style % looks.size()];
  const std::string markers = curve.every_point ? "" : " pointnumber 9";
  switch (curve.look) {
    case CurveLook::experiment:
      return "lines lw 2.2 lc rgb '#000000' dt solid";
    case CurveLook::guide:
      return "lines lw 1 lc rgb '#9AA5AB' dt (6,4)";
    case CurveLook::leader:
      return "lines lw 0.8 lc rgb '#9AA5AB' dt solid";
    case CurveLook::published:
      return curve.points_only ? "points pt 6 ps 1.1 lw 1.6 lc rgb '#555555'"
                               : "linespoints pt 6 ps 1.1 lw 1.6 lc rgb '#555555' dt (4,4)" + markers;
    case CurveLook::run:
      break;
  }
  if (curve.points_only) return fmt::format("points pt {} ps 1.1 lc rgb '{}'", look.marker, look.colour);
  return fmt::format("linespoints pt {} ps 0.8 lw 1.5 lc rgb '{}' dt {}{}", look.marker, look.colour, look.dashes,
                     markers);
}

/// Data blocks in the order in which the script refers to them by index.
class DataFile {
 public:
  explicit DataFile(const std::filesystem::path& file) : path_(file), out_(file) {}

  void begin(const std::string& comment) {
    gap_ = false;
    if (blocks_++ > 0) out_ << "\n\n";
    out_ << "# " << printable(comment) << '\n';
  }
  template <class... Values>
  void row(Values... values) {
    if (!(std::isfinite(values) && ...)) {
      gap_ = rows_ > 0;
      return;
    }
    if (std::exchange(gap_, false)) out_ << '\n';  // one blank line breaks a curve, two end its block
    const char* separator = "";
    ((out_ << separator << fmt::format("{:.6g}", values), separator = " "), ...);
    out_ << '\n';
    ++rows_;
  }
  void labelled_row(double x, double y, const std::string& label) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    out_ << fmt::format("{:.6g} {:.6g} \"{}\"\n", x, y, escape_gnuplot(label));
    ++rows_;
  }
  int index() const { return blocks_ - 1; }
  /// Rows since the last call: gnuplot stops at a block without rows, so the script must not ask for one.
  int take_rows() { return std::exchange(rows_, 0); }
  void close() {
    out_.close();
    if (!out_) throw std::runtime_error(path_.string() + ": cannot write the figure's data (is the disk full?)");
  }

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  int blocks_ = 0;
  int rows_ = 0;
  bool gap_ = false;
};

std::string range_text(const PlotRange& range) {
  auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string("*");
  };
  return fmt::format("[{}:{}]", end(range.first), end(range.second));
}

std::string plot_title(const std::string& label) {
  return label.empty() ? "notitle" : fmt::format("title \"{}\"", escape_gnuplot(label));
}

void add_band(const PlotBand& band, const std::string& data_name, DataFile& data, std::vector<std::string>& plots) {
  data.begin("band: " + band.label);
  for (std::size_t i = 0; i < band.x.size(); ++i) data.row(band.x[i], band.lower[i], band.upper[i]);
  if (data.take_rows() == 0) {
    data.row(0.0, 0.0, 0.0);
    data.take_rows();
    return;
  }
  plots.push_back(fmt::format("'{}' index {} using 1:2:3 with filledcurves lc rgb '#C9CED2' fs solid 1.0 noborder {}",
                              data_name, data.index(), plot_title(band.label)));
}

void add_curve(const PlotCurve& curve, const std::string& data_name, DataFile& data, std::vector<std::string>& plots) {
  data.begin("curve: " + curve.label);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (curve.point_labels.empty())
      data.row(curve.x[i], curve.y[i]);
    else
      data.labelled_row(curve.x[i], curve.y[i], curve.point_labels[i]);
  }
  if (data.take_rows() == 0) {
    data.row(0.0, 0.0);
    data.take_rows();
    return;
  }
  plots.push_back(fmt::format("'{}' index {} using 1:2 with {} {}", data_name, data.index(), line_style(curve),
                              plot_title(has_entry(curve) ? curve.label : "")));
  if (!curve.point_labels.empty())
    plots.push_back(
        fmt::format("'{}' index {} using 1:2:3 with labels offset 0.8,0.6 left notitle", data_name, data.index()));
}

void add_names(const std::vector<PlotName>& names, const std::string& data_name, DataFile& data,
               std::vector<std::string>& plots) {
  if (names.empty()) return;
  data.begin("names");
  for (const PlotName& name : names) data.labelled_row(name.x, name.y, name.text);
  data.take_rows();
  plots.push_back(
      fmt::format("'{}' index {} using 1:2:3 with labels center font ',13' notitle", data_name, data.index()));
}

std::string tick_words(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i)
    out += fmt::format("{}\"{}\" {}", i > 0 ? ", " : "", escape_gnuplot(words[i]), i + 1);
  return out;
}

/// 2 and 5 of every decade: gnuplot names powers of ten alone, of which an axis may hold one or none.
std::string between_decades() {
  std::string out;
  for (int decade = -6; decade <= 9; ++decade)
    out += fmt::format("{}2e{}, 5e{}", out.empty() ? "" : ", ", decade, decade);
  return out;
}

std::string axis_scale(char axis, bool log, bool room_between_decades) {
  if (!log) return fmt::format("unset logscale {0}\nset {0}tics autofreq nomirror\n", axis);
  return fmt::format("set logscale {0}\nset {0}tics autofreq nomirror\n{1}", axis,
                     room_between_decades ? fmt::format("set {}tics add ({})\n", axis, between_decades()) : "");
}

/// Of the points; numbers under an axis stand side by side.
double decades_across(const PlotPanel& panel) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const PlotCurve& curve : panel.curves)
    for (const double x : curve.x) {
      if (!(x > 0)) continue;
      least = std::min(least, x);
      most = std::max(most, x);
    }
  return most > least ? std::log10(most / least) : 0;
}

std::string panel_script(const PlotPanel& panel, const std::string& data_name, DataFile& data) {
  std::string out;
  out += fmt::format("set title \"{}\"\n", escape_gnuplot(panel.title));
  out += fmt::format("set xlabel \"{}\" offset 0,0.4\nset ylabel \"{}\"\n", escape_gnuplot(panel.x_label),
                     escape_gnuplot(panel.y_label));
  out += fmt::format("set xrange {}\nset yrange {}\n", range_text(panel.x_range), range_text(panel.y_range));
  out += axis_scale('x', panel.log_x, decades_across(panel) < 2.5) + axis_scale('y', panel.log_y, true);
  if (!panel.x_ticks.empty())
    out += fmt::format("set xtics nomirror {} ({})\n", panel.slanted_ticks ? "rotate by 32 right" : "norotate",
                       tick_words(panel.x_ticks));
  if (panel.slanted_ticks) out += "set rmargin 3\n";
  out += panel.equal_scale ? "set size ratio -1\n" : "set size noratio\n";
  std::vector<std::string> plots;
  for (const PlotBand& band : panel.bands) add_band(band, data_name, data, plots);
  for (const PlotCurve& curve : panel.curves) add_curve(curve, data_name, data, plots);
  add_names(panel.names, data_name, data, plots);
  if (plots.empty())
    return out + "set label 1 'no data' at graph 0.5,0.5 center\nplot [0:1] [0:1] 1/0 notitle\nunset label 1\n";
  out += "plot ";
  for (std::size_t i = 0; i < plots.size(); ++i) out += (i > 0 ? ", \\\n     " : "") + plots[i];
  return out + "\n";
}

constexpr const char* script_head = R"(# Drawn by sluice report; draw again with: gnuplot {0}.gp
# {1}
set terminal svg size {2},{3} dynamic enhanced font 'DejaVu Sans,15' background '#ffffff'
set output '{0}.svg'
set encoding utf8
set border 3 lc rgb '#40505A'
set tics nomirror
set grid back lc rgb '#E4E9EC' lw 0.8 dt solid
set format '%g'
set key below left reverse Left samplen 2 spacing 1.15 maxcols {4} font ',13' height 0.6 enhanced
set title font ',15' offset 0,-0.4
set offsets 0,0,graph 0.05,graph 0.05
)";

}  // namespace

std::filesystem::path draw(const PlotFigure& figure, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const int columns = std::max(1, figure.columns);
  const int panels = static_cast<int>(figure.panels.size());
  const int rows = std::max(1, (panels + columns - 1) / columns);
  DataFile data(folder / (figure.name + ".dat"));
  const PanelRoom room = room_of(figure);
  std::string script = fmt::format(fmt::runtime(script_head), figure.name, printable(figure.source, 2000),
                                   figure.panel_width_px * std::min(columns, std::max(1, panels)),
                                   room.height_px * rows, room.legend_columns);
  const bool several = panels > 1;
  if (several) script += fmt::format("set multiplot layout {},{}\n", rows, columns);
  for (const PlotPanel& panel : figure.panels) script += panel_script(panel, figure.name + ".dat", data);
  if (several) script += "unset multiplot\n";
  data.close();
  std::ofstream out(folder / (figure.name + ".gp"));
  out << script;
  out.close();
  if (!out) throw std::runtime_error((folder / (figure.name + ".gp")).string() + ": cannot write (is the disk full?)");
  run_gnuplot(folder, {figure.name + ".gp"});
  return folder / (figure.name + ".svg");
}

std::pair<std::vector<double>, std::vector<double>> thin_out(const std::vector<double>& x, const std::vector<double>& y,
                                                             double x_begin, double x_end, int columns) {
  std::pair<std::vector<double>, std::vector<double>> out;
  const double width = (x_end - x_begin) / columns;
  auto keep = [&](std::size_t i) {
    out.first.push_back(x[i]);
    out.second.push_back(y[i]);
  };
  std::size_t i = 0;
  while (i < x.size() && x[i] < x_begin) ++i;
  while (i < x.size() && x[i] <= x_end) {
    const double column = std::floor((x[i] - x_begin) / width);
    std::size_t low = i;
    std::size_t high = i;
    for (; i < x.size() && x[i] <= x_end && std::floor((x[i] - x_begin) / width) == column; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    keep(std::min(low, high));
    if (low != high) keep(std::max(low, high));
  }
  return out;
}

}  // namespace sluice
