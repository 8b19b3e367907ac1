// From TOML to a Case. Every check stands where its value is read, so that its message can name the line.
#include "validation/case_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/case.h"
#include "validation/file_hash.h"
#include "validation/solver_factory.h"
#include "validation/suggest.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

using case_parse::names_of;
using case_parse::one_of;

// Positions are given to a tenth of a millimetre at best.
constexpr double position_tolerance_m = 1e-6;

bool inside(const Box& box, const Vec3d& p) {
  constexpr double e = position_tolerance_m;
  return p.x >= box.lower.x - e && p.y >= box.lower.y - e && p.z >= box.lower.z - e && p.x <= box.upper.x + e &&
         p.y <= box.upper.y + e && p.z <= box.upper.z + e;
}

bool strictly_inside(const Box& box, const Vec3d& p) {
  constexpr double e = position_tolerance_m;
  return p.x > box.lower.x + e && p.y > box.lower.y + e && p.z > box.lower.z + e && p.x < box.upper.x - e &&
         p.y < box.upper.y - e && p.z < box.upper.z - e;
}

bool overlap(const Box& a, const Box& b) {
  constexpr double e = position_tolerance_m;
  return a.lower.x < b.upper.x - e && b.lower.x < a.upper.x - e && a.lower.y < b.upper.y - e &&
         b.lower.y < a.upper.y - e && a.lower.z < b.upper.z - e && b.lower.z < a.upper.z - e;
}

template <class T>
void refuse_repeated_name(const TomlReader& reader, const std::vector<T>& items, const std::string& name) {
  for (const T& item : items)
    if (item.name == name) reader.fail("name", fmt::format("`{}` occurs twice (give each its own name)", name));
}

Box parse_box(TomlReader& reader) {
  Box box{reader.vec3("lower_m"), reader.vec3("upper_m")};
  reader.finish();
  if (box.lower.x >= box.upper.x || box.lower.y >= box.upper.y || box.lower.z >= box.upper.z)
    reader.fail("upper_m", "does not lie above lower_m in x, y and z: a length is zero or negative (exchange them)");
  return box;
}

Box parse_box_in_tank(TomlReader reader, const Box& tank) {
  Box box = parse_box(reader);
  if (!inside(tank, box.lower)) reader.fail("lower_m", "lies outside of the tank (move it inside geometry.tank)");
  if (!inside(tank, box.upper)) reader.fail("upper_m", "lies outside of the tank (move it inside geometry.tank)");
  return box;
}

void parse_geometry(TomlReader reader, Case& c) {
  TomlReader tank = reader.table("tank");
  c.tank = parse_box(tank);
  for (TomlReader& fluid : reader.tables("fluid")) {
    c.fluid.push_back(parse_box_in_tank(fluid, c.tank));
    for (std::size_t other = 0; other + 1 < c.fluid.size(); ++other)
      if (overlap(c.fluid.back(), c.fluid[other]))
        fluid.fail("", fmt::format("overlaps geometry.fluid[{}] (let them touch at most)", other));
  }
  for (TomlReader& obstacle : reader.tables("obstacles", true)) {
    c.obstacles.push_back(parse_box_in_tank(obstacle, c.tank));
    for (const Box& fluid : c.fluid)
      if (overlap(c.obstacles.back(), fluid))
        obstacle.fail("", "overlaps the fluid (leave its space out of the fluid)");
  }
  reader.finish();
}

void parse_fluid_constants(TomlReader& root, Case& c) {
  c.gravity_m_s2 = root.vec3("gravity_m_s2");
  if (c.gravity_m_s2.x != 0 || c.gravity_m_s2.y != 0 || c.gravity_m_s2.z >= 0)
    root.fail("gravity_m_s2", "must point down the z axis, such as [0.0, 0.0, -9.81]");
  c.density_kg_m3 = root.positive_number("density_kg_m3");
  c.water_height_m = root.positive_number("water_height_m");
  double highest = 0;
  for (const Box& fluid : c.fluid) highest = std::max(highest, fluid.upper.z - c.tank.lower.z);
  if (std::abs(highest - c.water_height_m) > position_tolerance_m)
    root.fail("water_height_m",
              fmt::format("is {} m, but the fluid in geometry.fluid stands {} m high (make them agree)",
                          c.water_height_m, highest));
}

void check_sensor_place(const TomlReader& reader, const CaseSensor& sensor, const Case& c) {
  if (!inside(c.tank, sensor.position_m))
    reader.fail("position_m", "lies outside of the tank (give a point inside geometry.tank)");
  for (std::size_t k = 0; k < c.obstacles.size(); ++k)
    if (strictly_inside(c.obstacles[k], sensor.position_m))
      reader.fail("position_m", fmt::format("lies inside geometry.obstacles[{}] (move it to a face)", k));
  const double length = std::sqrt(dot(sensor.normal, sensor.normal));
  if (std::abs(length - 1) > 1e-9)
    reader.fail("normal", fmt::format("has length {}, must be a unit vector such as [1, 0, 0]", length));
}

CaseSensor parse_sensor(TomlReader& reader, const Case& c) {
  CaseSensor sensor;
  sensor.name = reader.text("name");
  refuse_repeated_name(reader, c.sensors, sensor.name);
  if (sensor.name.find_first_of("_,\" ") != std::string::npos)
    reader.fail("name", "has an underscore, comma, quote or blank (it becomes part of a column name in probes.csv)");
  const std::string kind = one_of(reader, "kind", {"pressure", "wave_height"});
  sensor.kind = kind == "pressure" ? SensorKind::pressure : SensorKind::wave_height;
  sensor.position_m = reader.vec3("position_m");
  sensor.normal = reader.vec3("normal");
  sensor.measured = reader.text_or("measured", "");
  check_sensor_place(reader, sensor, c);
  reader.finish();
  return sensor;
}

void parse_times(TomlReader& root, Case& c) {
  c.t_end_s = root.positive_number("t_end_s");
  std::tie(c.window.start_s, c.window.end_s) = root.range("window_s");
  if (c.window.start_s < 0 || c.window.start_s == c.window.end_s)
    root.fail("window_s", "must be a span of time that does not start before 0");
  c.output_rate_Hz = root.positive_number("output_rate_Hz");
  c.snapshot_times_s = root.numbers("snapshot_times_s");
  for (double t : c.snapshot_times_s)
    if (t < 0) root.fail("snapshot_times_s", fmt::format("holds {} s, must not be negative", t));
}

// A case may describe a solver that this program does not have; then its parameters cannot be checked either.
std::map<std::string, double> parse_parameters(TomlReader reader, const std::string& solver) {
  const std::vector<std::string> known = solver_parameter_names(solver);
  std::map<std::string, double> parameters;
  for (const auto& [key, value] : reader.all_numbers()) {
    if (!known.empty() && std::find(known.begin(), known.end(), key) == known.end())
      reader.fail(key, fmt::format("unknown parameter of solver {}{}", solver, suggestion(key, known)));
    parameters[key] = value;
  }
  return parameters;
}

WallOption parse_walls(TomlReader& reader, const SolverOption& solver) {
  WallOption walls;
  walls.name = reader.text("name");
  refuse_repeated_name(reader, solver.walls, walls.name);
  if (reader.has("parameters")) walls.parameters = parse_parameters(reader.table("parameters"), solver.name);
  walls.layers = reader.integer("layers");
  if (walls.layers < 1 || walls.layers > 10)
    reader.fail("layers", fmt::format("is {}, must be 1 to 10 particle layers", walls.layers));
  walls.pressure_model = one_of(reader, "pressure_model", {"wall", "kernel", "nearest"});
  walls.wave_height_model = one_of(reader, "wave_height_model", {"column", "top"});
  reader.finish();
  return walls;
}

SolverOption parse_solver(TomlReader& reader, const std::vector<SolverOption>& before) {
  SolverOption solver;
  solver.name = reader.text("name");
  refuse_repeated_name(reader, before, solver.name);
  for (TomlReader& walls : reader.tables("walls")) solver.walls.push_back(parse_walls(walls, solver));
  solver.default_walls = one_of(reader, "default_walls", names_of(solver.walls));
  solver.parameters = parse_parameters(reader.table("parameters"), solver.name);
  reader.finish();
  return solver;
}

Tier parse_tier(TomlReader& reader, const Case& c) {
  Tier tier;
  tier.name = reader.text("name");
  refuse_repeated_name(reader, c.tiers, tier.name);
  tier.l0_m = reader.positive_number("l0_m");
  tier.t_end_s = reader.positive_number("t_end_s");
  if (const std::string problem = particle_distance_problem(c, tier.l0_m); !problem.empty())
    reader.fail("l0_m", problem);
  reader.finish();
  return tier;
}

Case parse_root(TomlReader root) {
  Case c;
  c.name = root.text("name");
  c.title = root.text("title");
  c.reference = root.text("reference");
  parse_geometry(root.table("geometry"), c);
  parse_fluid_constants(root, c);
  for (TomlReader& sensor : root.tables("sensors")) c.sensors.push_back(parse_sensor(sensor, c));
  c.measured = root.text_or("measured", "");
  for (const CaseSensor& sensor : c.sensors)
    if (!sensor.measured.empty() && c.measured.empty())
      root.fail("measured",
                fmt::format("is missing, but sensor {} has a measured series (name the digest's file)", sensor.name));
  parse_times(root, c);
  for (TomlReader& solver : root.tables("solvers")) c.solvers.push_back(parse_solver(solver, c.solvers));
  c.default_solver = c.solvers.front().name;
  for (TomlReader& tier : root.tables("tiers")) c.tiers.push_back(parse_tier(tier, c));
  for (TomlReader& group : root.tables("acceptance", true)) case_parse::parse_acceptance_group(group, c);
  if (root.has("published")) case_parse::parse_published(root.table("published"), c);
  root.finish();
  return c;
}

}  // namespace

Case parse_case(std::string_view text, const std::string& file) {
  const toml::table table = parse_toml(text, file);
  Case c = parse_root(TomlReader(table, file));
  c.file = file;
  c.hash = fmt::format("fnv1a64:{:016x}", fnv1a64(text));
  return c;
}

}  // namespace sluice
