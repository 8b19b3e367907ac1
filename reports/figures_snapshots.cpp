// The paper's figures 3 and 11: particles at a few times, coloured by dimensionless pressure or velocity. Drawn as PNG:
// tens of thousands of discs are too many for a vector drawing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "reports/figures.h"
#include "reports/gnuplot.h"
#include "reports/snapshot_view.h"
#include "reports/studies.h"
#include "reports/text.h"
#include "solvers/snapshot.h"
#include "validation/printable.h"

namespace sluice {

namespace {

/// How a quantity is shown: on what scale, and in what words.
struct Scale {
  ParticleColour colour;
  double tick = 0.25;
  std::string symbol;
  std::string label;
  std::string words;
};

const Scale& scale_of(const Case& the_case) {
  static const Scale pressure{{ParticleColour::Of::pressure, 1.0},
                              0.25,
                              "P*",
                              "dimensionless pressure P* = P / (ρ g H_W)",
                              "dimensionless pressure"};
  // A front on a dry bed runs at 2 sqrt(g H).
  static const Scale velocity{{ParticleColour::Of::velocity, 2.0},
                              0.5,
                              "v*",
                              "dimensionless velocity v* = |u| / √(g H_W)",
                              "dimensionless velocity"};
  return the_case.published.snapshots_colour == "velocity" ? velocity : pressure;
}

constexpr double nearest_within_s = 0.03;
constexpr int panel_width_px = 760;

std::vector<SnapshotEntry> entries_of(const AnalysedRun& run) {
  const std::filesystem::path collection = run.record.path / "snapshots.pvd";
  if (std::filesystem::exists(collection)) return read_pvd(collection);
  std::vector<SnapshotEntry> entries;
  for (const auto& file : run.record.snapshots()) entries.push_back({read_vtp(file).time_s, file});
  return entries;
}

/// The snapshot nearest each of the case's times; times without one are left out.
std::vector<SnapshotEntry> chosen_entries(const AnalysedRun& run, const std::vector<double>& times_s) {
  std::vector<SnapshotEntry> chosen;
  const std::vector<SnapshotEntry> entries = entries_of(run);
  for (double time : times_s) {
    const auto nearest = std::min_element(entries.begin(), entries.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.time_s - time) < std::abs(b.time_s - time);
    });
    if (nearest != entries.end() && std::abs(nearest->time_s - time) <= nearest_within_s) chosen.push_back(*nearest);
  }
  return chosen;
}

void write_discs(std::ofstream& out, const std::vector<SnapshotDisc>& discs) {
  for (const SnapshotDisc& disc : discs) out << fmt::format("{:.4f} {:.4f} {}\n", disc.x, disc.y, disc.colour);
  out << "\n\n";
}

/// Arrows numbered from `first` on, so that they can be taken away again.
std::string edges_script(const Box& box, const char* colour, int first) {
  std::string out;
  for (const auto& [from, to] : box_edges(box))
    out += fmt::format("set arrow {} from {:.4f},{:.4f} to {:.4f},{:.4f} nohead lw 1 lc rgb '{}' back\n", first++,
                       from.first, from.second, to.first, to.second, colour);
  return out;
}

constexpr const char* edge_colour = "#8A979F";
constexpr const char* moving_edge_colour = "#D55E00";
constexpr int edges_of_a_box = 12;

/// Bodies that move, where they are at a time; `first` is the number of their first arrow.
std::string moving_edges_script(const Case& the_case, double t_s, int first) {
  std::string out;
  for (const Obstacle& obstacle : the_case.obstacles) {
    if (!obstacle.motion.moves()) continue;
    for (int k = 0; k < edges_of_a_box; ++k) out += fmt::format("unset arrow {}\n", first + k);
    if (const auto box = obstacle_at(obstacle, t_s, the_case.tank))
      out += edges_script(*box, moving_edge_colour, first);
    first += edges_of_a_box;
  }
  return out;
}

constexpr const char* snapshots_head = R"(# Drawn by sluice report from the snapshots of {0}
# (the projected particles are made anew each time and not kept).
set terminal pngcairo size {1},{2} font 'DejaVu Sans,15' background '#ffffff'
set output '{3}.png'
set encoding utf8
unset border
unset tics
unset key
set size ratio -1
set lmargin 1
set rmargin 1
set tmargin 2
set bmargin 0
set xrange [{4:.4f}:{5:.4f}]
set yrange [{6:.4f}:{7:.4f}]
)";

constexpr const char* colour_bar = R"(set palette defined ({0})
set cbrange [0:{1}]
set cbtics {5}
set cblabel '{6}' offset 0,0.3
set colorbox horizontal user origin screen 0.3,{2:.4f} size screen 0.4,{3:.4f}
unset arrow
unset title
plot '{4}.dat' index 0 using (NaN):(NaN):(0) with points palette
unset multiplot
)";

std::string palette_stops() {
  std::string out;
  for (int i = 0; i <= 9; ++i) out += fmt::format("{}{} '#{:06X}'", i > 0 ? ", " : "", i, viridis(i / 9.0));
  return out;
}

/// Sizes of the picture, in pixels and in metres of the drawing plane.
struct SnapshotFrame {
  double left = 0, right = 0, bottom = 0, top = 0;
  int rows = 1;
  int total_px = 0;
};

constexpr int title_px = 34;
constexpr int bar_px = 116;

SnapshotFrame frame_of(const Case& the_case, std::size_t panels) {
  constexpr double margin = 0.05;
  const auto [left, bottom] = project(the_case.tank.lower);
  const auto [right, top] = project(the_case.tank.upper);
  SnapshotFrame frame{left - margin, right + margin, bottom - margin, top + margin, 1, 0};
  frame.rows = (static_cast<int>(panels) + 1) / 2;
  const double shape = (frame.top - frame.bottom) / (frame.right - frame.left);
  frame.total_px = frame.rows * (static_cast<int>(panel_width_px * shape) + title_px) + bar_px;
  return frame;
}

/// Arrows 1 to 12 are the tank's, then those of bodies at rest, then those of bodies that move.
int first_moving_arrow(const Case& the_case) {
  const auto at_rest = std::count_if(the_case.obstacles.begin(), the_case.obstacles.end(),
                                     [](const Obstacle& obstacle) { return !obstacle.motion.moves(); });
  return 1 + edges_of_a_box * (1 + static_cast<int>(at_rest));
}

std::string snapshot_script_head(const Case& the_case, const SnapshotFrame& frame, const std::string& name,
                                 const std::string& label) {
  const double total = frame.total_px;
  std::string script = fmt::format(fmt::runtime(snapshots_head), printable(label), 2 * panel_width_px, frame.total_px,
                                   name, frame.left, frame.right, frame.bottom, frame.top);
  script += fmt::format("set multiplot layout {},2 margins 0.01,0.99,{:.4f},{:.4f} spacing 0.01,{:.4f}\n", frame.rows,
                        bar_px / total, 1.0 - 30.0 / total, title_px / total);
  int arrow = first_moving_arrow(the_case);
  script += edges_script(the_case.tank, edge_colour, 1);
  for (const Obstacle& obstacle : the_case.obstacles) {
    if (obstacle.motion.moves()) continue;
    arrow -= edges_of_a_box;
    script += edges_script(obstacle.box, edge_colour, arrow);
  }
  return script;
}

bool anything_moves(const Case& the_case) {
  return std::any_of(the_case.obstacles.begin(), the_case.obstacles.end(),
                     [](const Obstacle& obstacle) { return obstacle.motion.moves(); });
}

bool is_alike(double value, double other) {
  return std::abs(value - other) < 1e-9 * std::abs(other);
}

/// Of which figure of the paper these are the counterpart, and what the paper's panels have otherwise than the run.
std::string papers_snapshots(const Published& published, const RunRecord& run) {
  if (published.snapshots_figure == 0) return "";
  std::string apart;
  const auto& alpha = published.snapshots_alpha;
  if (run.solver == "wcsph" && alpha && !(run.alpha() && is_alike(*run.alpha(), *alpha)))
    apart = fmt::format(" WCSPH at α = {}", shortest(*alpha));
  if (const auto& l0_m = published.snapshots_l0_m; l0_m && !is_alike(run.l0_m, *l0_m))
    apart += fmt::format("{} l0 = {:g} mm", apart.empty() ? "" : " and", 1000 * *l0_m);
  return apart.empty() ? fmt::format(" (the paper's figure {})", published.snapshots_figure)
                       : fmt::format(" (after the paper's figure {}, which has{})", published.snapshots_figure, apart);
}

std::string snapshot_caption(const Case& the_case, const AnalysedRun& run, const std::string& times) {
  const int number = the_case.published.snapshots_figure;
  const std::string figure = papers_snapshots(the_case.published, run.record);
  const Scale& scale = scale_of(the_case);
  return fmt::format(
      "{}: particles at t = {} s{}, coloured by {}; values above {:g} take the brightest colour. Only what nothing "
      "nearer hides is drawn; the tank's own walls are left out{}.{}",
      run.label, times, figure, scale.symbol, scale.colour.largest,
      anything_moves(the_case) ? ", and so is a body that has moved out of the tank" : "",
      number > 0 ? " The experiment's photographs are not part of the comparison." : "");
}

Picture draw_snapshots(const FigureMaker& maker, const AnalysedRun& run, const std::vector<SnapshotEntry>& entries) {
  Case the_case = maker.data.the_case;
  the_case.obstacles = placed_obstacles(the_case, run.record);
  const std::string name = "snapshots_" + run.key;
  const std::filesystem::path folder = maker.report_folder / "figures";
  std::filesystem::create_directories(folder);
  const SnapshotFrame frame = frame_of(the_case, entries.size());
  std::string script = snapshot_script_head(the_case, frame, name, run.label);
  std::ofstream data(folder / (name + ".dat"));
  const Scale& scale = scale_of(the_case);
  int index = 0;
  std::string times;
  for (const SnapshotEntry& entry : entries) {
    write_discs(data, snapshot_discs(read_vtp(entry.file), the_case, run.record.l0_m, scale.colour));
    script += moving_edges_script(the_case, entry.time_s, first_moving_arrow(the_case));
    script += fmt::format("set title 't = {:.2f} s' offset 0,-0.5\n", entry.time_s);
    script += fmt::format(
        "plot '{}.dat' index {} using 1:2:({:.5f}):3 with circles lc rgb variable fill solid 1.0 noborder\n", name,
        index++, 0.72 * run.record.l0_m);
    times += fmt::format("{}{:.2f}", times.empty() ? "" : ", ", entry.time_s);
  }
  data.close();
  script += fmt::format(fmt::runtime(colour_bar), palette_stops(), scale.colour.largest, 80.0 / frame.total_px,
                        18.0 / frame.total_px, name, scale.tick, scale.label);
  std::ofstream(folder / (name + ".gp")) << script;
  run_gnuplot(folder, {name + ".gp"});
  std::filesystem::remove(folder / (name + ".dat"));
  return {name, snapshot_caption(the_case, run, times), "Particles of the dam break coloured by " + scale.words,
          std::filesystem::path("figures") / (name + ".png"), true};
}

}  // namespace

std::vector<Picture> snapshot_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  for (const AnalysedRun& run : maker.data.runs) {
    const auto entries = chosen_entries(run, maker.data.the_case.snapshot_times_s);
    if (!entries.empty()) pictures.push_back(draw_snapshots(maker, run, entries));
  }
  return pictures;
}

}  // namespace sluice
