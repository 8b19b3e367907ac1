// The faces that carry pressure sensors, enlarged: in plan and elevation these sensors lie too close to be told apart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures.h"

namespace sluice {
namespace {

struct Body {
  std::string name;
  Box box;
  bool is_tank = false;  ///< the fluid is inside
};

/// A face of a body with the pressure sensors on it.
struct SensorFace {
  Body body;
  int axis = 0;  ///< of its normal into the fluid
  bool upwards = false;
  std::vector<const CaseSensor*> sensors;

  double at_m() const { return component(upwards != body.is_tank ? body.box.upper : body.box.lower, axis); }
  double begin_m(int along) const { return component(body.box.lower, along); }
  double end_m(int along) const { return component(body.box.upper, along); }
  double length_m(int along) const { return end_m(along) - begin_m(along); }
};

constexpr const char* axis_letters = "xyz";

bool carries(const SensorFace& face, const CaseSensor& sensor) {
  constexpr double off_face_m = 1e-3;  // sources place a sensor's membrane a little off its face
  constexpr double least_cosine = 0.9;
  const double cosine = component(sensor.normal, face.axis) * (face.upwards ? 1 : -1);
  return sensor.kind == SensorKind::pressure && cosine > least_cosine &&
         std::abs(component(sensor.position_m, face.axis) - face.at_m()) < off_face_m &&
         holds_point(grown(face.body.box, off_face_m), sensor.position_m);
}

std::vector<SensorFace> faces_with_sensors(const Case& c, const Body& body) {
  std::vector<SensorFace> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upwards : {true, false}) {
      SensorFace face{body, axis, upwards, {}};
      for (const CaseSensor& sensor : c.sensors)
        if (carries(face, sensor)) face.sensors.push_back(&sensor);
      if (!face.sensors.empty()) faces.push_back(std::move(face));
    }
  return faces;
}

/// Of bodies with two sensors or more: one alone is told apart in plan and elevation.
std::vector<SensorFace> enlarged_faces(const Case& c) {
  std::vector<Body> bodies{{"tank", c.tank, true}};
  for (const Obstacle& obstacle : c.obstacles)
    bodies.push_back({obstacle.name.empty() ? "obstacle" : obstacle.name, obstacle.box, false});
  std::vector<SensorFace> enlarged;
  for (const Body& body : bodies) {
    const std::vector<SensorFace> faces = faces_with_sensors(c, body);
    std::size_t sensors = 0;
    for (const SensorFace& face : faces) sensors += face.sensors.size();
    if (sensors >= 2) enlarged.insert(enlarged.end(), faces.begin(), faces.end());
  }
  return enlarged;
}

/// Upright faces stand upright; level ones lie along their longer side.
std::pair<int, int> axes_drawn(const SensorFace& face) {
  if (face.axis == 0) return {1, 2};
  if (face.axis == 1) return {0, 2};
  return face.length_m(0) < face.length_m(1) ? std::pair(1, 0) : std::pair(0, 1);
}

PlotPanel face_panel(const SensorFace& face) {
  const auto [across, up] = axes_drawn(face);
  const double margin_m = 0.08 * std::max(face.length_m(across), face.length_m(up));
  PlotPanel panel;
  panel.title = fmt::format("Face {}{} of the {}, {} = {:g} m", axis_letters[face.axis], face.upwards ? '+' : '-',
                            face.body.name, axis_letters[face.axis], face.at_m());
  panel.x_label = fmt::format("{} [m]", axis_letters[across]);
  panel.y_label = fmt::format("{} [m]", axis_letters[up]);
  panel.x_range = {face.begin_m(across) - margin_m, face.end_m(across) + margin_m};
  panel.y_range = {face.begin_m(up) - margin_m, face.end_m(up) + margin_m};
  panel.equal_scale = true;
  panel.bands.push_back({"",
                         {face.begin_m(across), face.end_m(across)},
                         {face.begin_m(up), face.begin_m(up)},
                         {face.end_m(up), face.end_m(up)}});
  PlotCurve sensors;  // without an entry in the legend: each point has its own name
  sensors.points_only = true;
  for (const CaseSensor* sensor : face.sensors) {
    sensors.x.push_back(component(sensor->position_m, across));
    sensors.y.push_back(component(sensor->position_m, up));
    sensors.point_labels.push_back(sensor->name);
  }
  panel.curves.push_back(std::move(sensors));
  return panel;
}

}  // namespace

std::vector<Picture> sensor_face_figures(const FigureMaker& maker) {
  if (!maker.enabled) return {};
  const Case& c = maker.data.the_case;
  PlotFigure figure;
  figure.name = "pressure_sensors";
  figure.panel_height_px = 380;
  figure.source = "positions as in the case file";
  for (const SensorFace& face : enlarged_faces(c)) figure.panels.push_back(face_panel(face));
  if (figure.panels.empty()) return {};
  const int number = c.published.geometry_figure;
  const std::string paper = number > 0 ? fmt::format(" (in the paper part of figure {})", number) : "";
  return {draw_picture(maker, figure,
                       fmt::format("Where the pressure sensors stand{}: every face that carries some, in the tank's "
                                   "coordinates, both axes to one scale. A face is named by its normal into the fluid.",
                                   paper),
                       "Faces with pressure sensors, each sensor marked and named")};
}

}  // namespace sluice
