// The sensors of a case file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "validation/case_parse.h"

namespace sluice::case_parse {
namespace {

void check_sensor_place(const TomlReader& reader, const CaseSensor& sensor, const Case& c) {
  if (!inside(c.tank, sensor.position_m))
    reader.fail("position_m", "lies outside of the tank (give a point inside geometry.tank)");
  for (std::size_t k = 0; k < c.obstacles.size(); ++k)
    if (holds_inside(grown(c.obstacles[k].box, -drawn_tolerance_m), sensor.position_m))
      reader.fail("position_m", fmt::format("lies inside geometry.obstacles[{}] (move it to a face)", k));
}

// A column's name is `<sensor>[_<model>]_<unit>`: a name that begins like another sensor's could be taken for it.
void check_sensor_name(const TomlReader& reader, const std::string& name, const Case& c) {
  refuse_repeated_name(reader, c.sensors, name);
  if (name.find_first_of(",\" ") != std::string::npos)
    reader.fail("name", "has a comma, quote or blank (it becomes part of a column name in probes.csv)");
  for (const CaseSensor& other : c.sensors)
    if (name.starts_with(other.name + "_") || other.name.starts_with(name + "_"))
      reader.fail("name", fmt::format("cannot be told from sensor {} by the columns of probes.csv (choose another)",
                                      other.name));
}

SensorKind parse_kind(TomlReader& reader) {
  std::map<std::string, SensorKind> kinds;
  std::vector<std::string> names;
  for (const SensorKind kind : sensor_kinds()) kinds[names.emplace_back(to_string(kind))] = kind;
  return kinds.at(one_of(reader, "kind", names));
}

BodyFace parse_face(TomlReader& reader) {
  if (!reader.has("face")) return {};
  const std::string name = one_of(reader, "face", {"x-", "x+", "y-", "y+", "z-", "z+"});
  return {name[0] - 'x', name[1] == '+'};
}

void parse_force(TomlReader& reader, CaseSensor& sensor, const Case& c) {
  std::vector<std::string> bodies{"tank"};
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.name.empty()) bodies.push_back(obstacle.name);
  sensor.body = one_of(reader, "body", bodies);
  sensor.face = parse_face(reader);
  sensor.normal = parse_unit_vector(reader, "direction");
}

void parse_measured(TomlReader& reader, CaseSensor& sensor) {
  sensor.measured = reader.text_or("measured", "");
  sensor.measured_in = reader.text_or("measured_in", "");
  sensor.measured_shift_s = reader.number_or("measured_shift_s", 0);
  sensor.measured_is_band = reader.flag_or("measured_is_band", false);
  for (const char* key : {"measured_in", "measured_shift_s", "measured_is_band"})
    if (sensor.measured.empty() && reader.has(key))
      reader.fail(key, "says how a series was measured, but `measured` names none (add it, or leave this out)");
  if (reader.has("window_s")) sensor.window = case_parse::parse_window(reader, "window_s");
  sensor.impulses_s = case_parse::parse_windows(reader, "impulses_s");
}

}  // namespace

bool inside(const Box& box, const Vec3d& p) {
  return holds_point(grown(box, drawn_tolerance_m), p);
}

Vec3d parse_unit_vector(TomlReader& reader, std::string_view key) {
  const Vec3d v = reader.vec3(key);
  const double length = std::sqrt(dot(v, v));
  if (std::abs(length - 1) > 1e-9)
    reader.fail(key, fmt::format("has length {}, must be a unit vector such as [1, 0, 0]", length));
  return v;
}

CaseSensor parse_sensor(TomlReader& reader, const Case& c) {
  CaseSensor sensor;
  sensor.name = reader.text("name");
  check_sensor_name(reader, sensor.name, c);
  sensor.kind = parse_kind(reader);
  if (sensor.kind == SensorKind::force) {
    parse_force(reader, sensor, c);
  } else {
    sensor.position_m = reader.vec3("position_m");
    check_sensor_place(reader, sensor, c);
    sensor.normal = parse_unit_vector(reader, sensor.kind == SensorKind::velocity ? "direction" : "normal");
  }
  parse_measured(reader, sensor);
  reader.finish();
  return sensor;
}

}  // namespace sluice::case_parse
