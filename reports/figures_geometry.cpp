// The case at the start, drawn from its boxes: plan and elevation, with the lengths between their edges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "reports/figures.h"
#include "reports/gnuplot.h"
#include "reports/studies.h"
#include "reports/text.h"

namespace sluice {
namespace {

constexpr int picture_width_px = 1000;
constexpr double side_px = 110;   // left and right of the tank: for the chains of lengths
constexpr double gap_px = 120;    // between plan and elevation
constexpr double under_px = 110;  // below the elevation
constexpr double over_px = 40;
constexpr double chain_px = 26;   // from the tank to its chain of lengths
constexpr double narrow_px = 44;  // shorter lengths are labelled at right angles
constexpr const char* ink = "#40505A";

/// From metres of a view to pixels of the picture.
struct View {
  double left_px = 0;
  double bottom_px = 0;
  double px_per_m = 0;
  int across = 0;  ///< axis drawn to the right
  int up = 0;      ///< axis drawn upwards
  Vec3d origin;

  double x(const Vec3d& p) const { return left_px + px_per_m * (component(p, across) - component(origin, across)); }
  double y(const Vec3d& p) const { return bottom_px + px_per_m * (component(p, up) - component(origin, up)); }
};

class Drawing {
 public:
  void box(const View& view, const Box& b, const std::string& fill, const std::string& edge) {
    text_ += fmt::format(
        "set object rectangle from {:.1f},{:.1f} to {:.1f},{:.1f} fc rgb '{}' fs {} border lc rgb '{}' lw 1.3 back\n",
        view.x(b.lower), view.y(b.lower), view.x(b.upper), view.y(b.upper), fill.empty() ? "#ffffff" : fill,
        fill.empty() ? "empty" : "transparent solid 0.75", edge);
  }
  void line(double x0, double y0, double x1, double y1, const std::string& look) {
    text_ +=
        fmt::format("set arrow from {:.1f},{:.1f} to {:.1f},{:.1f} {} lc rgb '{}' front\n", x0, y0, x1, y1, look, ink);
  }
  void label(double x, double y, const std::string& words, const std::string& look) {
    text_ +=
        fmt::format("set label \"{}\" at {:.1f},{:.1f} {} tc rgb '{}' front\n", escape_gnuplot(words), x, y, look, ink);
  }
  void point(double x, double y) {
    text_ += fmt::format("set label \"\" at {:.1f},{:.1f} point pt 7 ps 0.7 lc rgb '#D55E00' front\n", x, y);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Where the boxes begin and end along an axis, sorted, each once, the tank's ends included.
std::vector<double> edges_along(const Case& c, int axis) {
  std::vector<double> edges;
  const auto add = [&](const Box& b) {
    edges.push_back(component(b.lower, axis));
    edges.push_back(component(b.upper, axis));
  };
  add(c.tank);
  for (const Box& fluid : c.fluid) add(fluid);
  for (const Obstacle& obstacle : c.obstacles) add(obstacle.box);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(), [](double a, double b) { return std::abs(a - b) < 1e-6; }),
              edges.end());
  return edges;
}

std::string metres(double length_m) {
  return fmt::format("{:.4g}", length_m);
}

/// Lengths one after the other along a line: across the picture or up it, as `upright` says.
void draw_chain(Drawing& drawing, const std::vector<double>& edges_m, double start_px, double px_per_m, double at_px,
                bool upright) {
  const auto place = [&](double metre) { return start_px + px_per_m * (metre - edges_m.front()); };
  for (std::size_t k = 0; k + 1 < edges_m.size(); ++k) {
    const double from = place(edges_m[k]);
    const double to = place(edges_m[k + 1]);
    const bool narrow = to - from < (upright ? 15 : narrow_px);
    const std::string look = to - from < 24 ? "nohead lw 1.2" : "heads size 7,18 filled lw 1";
    const std::string words = metres(edges_m[k + 1] - edges_m[k]);
    const double middle = 0.5 * (from + to);
    if (upright) {
      drawing.line(at_px, from, at_px, to, look);
      drawing.line(at_px - 4, from, at_px + 4, from, "nohead lw 1");
      drawing.line(at_px - 4, to, at_px + 4, to, "nohead lw 1");
      drawing.label(at_px - (narrow && k % 2 == 1 ? 44 : 8), middle, words, "right");
    } else {
      drawing.line(from, at_px, to, at_px, look);
      drawing.line(from, at_px - 4, from, at_px + 4, "nohead lw 1");
      drawing.line(to, at_px - 4, to, at_px + 4, "nohead lw 1");
      drawing.label(middle, at_px - (narrow ? 8 : 14), words, narrow ? "right rotate by 90" : "center");
    }
  }
}

std::string obstacle_words(const Obstacle& obstacle) {
  if (!obstacle.motion.moves()) return obstacle.name.empty() ? "obstacle" : obstacle.name;
  const double speed = std::sqrt(dot(obstacle.motion.velocity_m_s, obstacle.motion.velocity_m_s));
  return fmt::format("{}, moves at {:g} m/s", obstacle.name.empty() ? "body" : obstacle.name, speed);
}

/// Sensors of a kind that stand close together share a label, the first and the last of them, at their upper right.
struct SensorMark {
  SensorKind kind = SensorKind::pressure;
  double first_x = 0, first_y = 0, right = 0, top = 0;
  std::vector<std::string> names;
};

std::vector<SensorMark> sensor_marks(const View& view, const Case& c) {
  constexpr double close_px = 60;
  std::vector<SensorMark> marks;
  for (const CaseSensor& sensor : c.sensors) {
    if (sensor.kind == SensorKind::force) continue;
    const double x = view.x(sensor.position_m);
    const double y = view.y(sensor.position_m);
    const auto found = std::find_if(marks.begin(), marks.end(), [&](const SensorMark& m) {
      return m.kind == sensor.kind && std::hypot(m.first_x - x, m.first_y - y) < close_px;
    });
    if (found == marks.end()) {
      marks.push_back({sensor.kind, x, y, x, y, {sensor.name}});
      continue;
    }
    found->right = std::max(found->right, x);
    found->top = std::max(found->top, y);
    found->names.push_back(sensor.name);
  }
  return marks;
}

void draw_sensors(Drawing& drawing, const View& view, const Case& c) {
  for (const CaseSensor& sensor : c.sensors)
    if (sensor.kind != SensorKind::force) drawing.point(view.x(sensor.position_m), view.y(sensor.position_m));
  for (const SensorMark& mark : sensor_marks(view, c)) {
    const std::string words =
        mark.names.size() == 1 ? mark.names.front() : mark.names.front() + " … " + mark.names.back();
    const double above_px = mark.kind == SensorKind::pressure ? 34 : 12;  // kinds do not write over each other
    drawing.label(mark.right + 8, mark.top + above_px, words, "left");
  }
}

void draw_view(Drawing& drawing, const View& view, const Case& c) {
  drawing.box(view, c.tank, "", ink);
  for (const Box& fluid : c.fluid) drawing.box(view, fluid, "#BFDDF2", "#0072B2");
  for (const Obstacle& obstacle : c.obstacles) {
    const bool moves = obstacle.motion.moves();
    drawing.box(view, obstacle.box, moves ? "#F2C9A0" : "#B9C2C8", moves ? "#D55E00" : ink);
  }
  draw_sensors(drawing, view, c);
}

/// Names in the plan, where bodies lie side by side.
void name_bodies(Drawing& drawing, const View& plan, const Case& c) {
  const auto middle = [](const Box& b) { return 0.5 * (b.lower + b.upper); };
  const Box* deepest = &c.fluid.front();
  for (const Box& fluid : c.fluid)
    if (fluid.upper.z - fluid.lower.z > deepest->upper.z - deepest->lower.z) deepest = &fluid;
  const Vec3d water = 0.5 * (middle(*deepest) + deepest->lower);  // off the middle, where sensors like to stand
  drawing.label(plan.x(middle(*deepest)), plan.y(water), "water", "center");
  for (const Obstacle& obstacle : c.obstacles) {
    const double width = plan.px_per_m * (obstacle.box.upper.x - obstacle.box.lower.x);
    const std::string& words = obstacle.name;
    const bool upright = width < 8.5 * static_cast<double>(words.size());
    const Vec3d at = middle(obstacle.box);
    if (!upright)
      drawing.label(plan.x(at), plan.y(at), words, "center");
    else if (width >= 16)
      drawing.label(plan.x(at), plan.y(at), words, "center rotate by 90");
    else
      drawing.label(plan.x(obstacle.box.lower) - 10, plan.y(at), words, "center rotate by 90");
  }
}

struct Size {
  View plan;
  View elevation;
  double height_px = 0;
};

Size size_of(const Case& c) {
  const Vec3d lengths = c.tank.upper - c.tank.lower;
  const double px_per_m = (picture_width_px - 2 * side_px) / lengths.x;
  Size size;
  size.elevation = {side_px, under_px, px_per_m, 0, 2, c.tank.lower};
  size.plan = {side_px, under_px + px_per_m * lengths.z + gap_px, px_per_m, 0, 1, c.tank.lower};
  size.height_px = size.plan.bottom_px + px_per_m * lengths.y + over_px;
  return size;
}

std::string geometry_script(const Case& c, const Size& size) {
  Drawing drawing;
  draw_view(drawing, size.plan, c);
  draw_view(drawing, size.elevation, c);
  name_bodies(drawing, size.plan, c);
  const double scale = size.plan.px_per_m;
  const std::vector<double> ends{c.tank.lower.x, c.tank.upper.x};
  draw_chain(drawing, edges_along(c, 1), size.plan.bottom_px, scale, side_px - chain_px, true);
  draw_chain(drawing, edges_along(c, 2), size.elevation.bottom_px, scale, side_px - chain_px, true);
  draw_chain(drawing, edges_along(c, 0), side_px, scale, size.elevation.bottom_px - chain_px, false);
  draw_chain(drawing, ends, side_px, scale, size.elevation.bottom_px - 3 * chain_px, false);
  const double right = side_px + scale * (c.tank.upper.x - c.tank.lower.x) + chain_px;
  for (const auto& [view, axis] : {std::pair(&size.plan, 1), std::pair(&size.elevation, 2)})
    draw_chain(drawing, {component(c.tank.lower, axis), component(c.tank.upper, axis)}, view->bottom_px, scale,
               right + 44, true);
  drawing.label(side_px, size.height_px - 14, "Plan: x to the right, y upwards; lengths in m", "left");
  drawing.label(side_px, size.elevation.bottom_px + scale * (c.tank.upper.z - c.tank.lower.z) + 16,
                "Elevation: x to the right, z upwards", "left");
  return fmt::format(
             "# Drawn by sluice report from the case file; draw again with: gnuplot initial_geometry.gp\n"
             "set terminal svg size {0},{1:.0f} dynamic enhanced font 'DejaVu Sans,14' background '#ffffff'\n"
             "set output 'initial_geometry.svg'\nset encoding utf8\nunset border\nunset tics\nunset key\n"
             "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
             "set xrange [0:{0}]\nset yrange [0:{1:.0f}]\n",
             picture_width_px, size.height_px) +
         drawing.text() + "plot NaN notitle\n";
}

/// What the picture cannot label: how large each body is.
std::string sizes_in_words(const Case& c) {
  const auto size = [](const Box& b) {
    const Vec3d l = b.upper - b.lower;
    return fmt::format("{} × {} × {} m", metres(l.x), metres(l.y), metres(l.z));
  };
  std::string words = fmt::format("Length × width × height: tank {}", size(c.tank));
  for (std::size_t k = 0; k < c.fluid.size(); ++k)
    words += fmt::format(", water {}{}", c.fluid.size() > 1 ? fmt::format("{} ", k + 1) : "", size(c.fluid[k]));
  for (const Obstacle& obstacle : c.obstacles)
    words += fmt::format(", {} {}", obstacle_words(obstacle), size(obstacle.box));
  return words + ".";
}

/// Runs that place a body elsewhere than it is drawn.
std::string placed_elsewhere(const ReportData& data) {
  std::string words;
  for (const AnalysedRun& run : data.runs)
    for (const Placement& placement : data.the_case.placements)
      if (const double at_m = placed_at_m(placement, run.record); at_m != placement.drawn_m)
        words += fmt::format("{}{} {} m ({})", words.empty() ? "" : ", ", placement.name, metres(at_m), run.key);
  return words.empty() ? "" : " Placed elsewhere: " + words + ".";
}

}  // namespace

std::vector<Picture> geometry_figures(const FigureMaker& maker) {
  if (!maker.enabled) return {};
  const Case& c = maker.data.the_case;
  const std::filesystem::path folder = maker.report_folder / "figures";
  std::filesystem::create_directories(folder);
  std::ofstream out(folder / "initial_geometry.gp");
  out << geometry_script(c, size_of(c));
  out.close();
  if (!out) throw std::runtime_error((folder / "initial_geometry.gp").string() + ": cannot write (is the disk full?)");
  run_gnuplot(folder, {"initial_geometry.gp"});
  const int number = c.published.geometry_figure;
  const std::string paper = number > 0 ? fmt::format(" (the paper's figure {})", number) : "";
  return {{"initial_geometry",
           fmt::format("The case at t = 0{}, as its file gives it, before lengths are fitted to a lattice. {}{}", paper,
                       sizes_in_words(c), placed_elsewhere(maker.data)),
           "Plan and elevation of tank, water, obstacles and sensors with their lengths",
           std::filesystem::path("figures") / "initial_geometry.svg", true}};
}

}  // namespace sluice
