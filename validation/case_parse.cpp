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

template <class T>
void refuse_repeated_name(const TomlReader& reader, const std::vector<T>& items, const std::string& name) {
  for (const T& item : items)
    if (item.name == name) reader.fail("name", fmt::format("`{}` occurs twice (give each its own name)", name));
}

Box parse_box(TomlReader& reader) {
  Box box{reader.vec3("lower_m"), reader.vec3("upper_m")};
  if (box.lower.x >= box.upper.x || box.lower.y >= box.upper.y || box.lower.z >= box.upper.z)
    reader.fail("upper_m", "does not lie above lower_m in x, y and z: a length is zero or negative (exchange them)");
  return box;
}

Box parse_box_in_tank(TomlReader& reader, const Box& tank) {
  Box box = parse_box(reader);
  if (!inside(tank, box.lower)) reader.fail("lower_m", "lies outside of the tank (move it inside geometry.tank)");
  if (!inside(tank, box.upper)) reader.fail("upper_m", "lies outside of the tank (move it inside geometry.tank)");
  return box;
}

// A body that moves rises out of the tank, or says when it stops.
RigidMotion parse_motion(TomlReader& reader) {
  RigidMotion motion;
  if (!reader.has("velocity_m_s")) return motion;
  motion.velocity_m_s = reader.vec3("velocity_m_s");
  motion.start_s = reader.number_or("start_s", 0);
  motion.stop_s = reader.number_or("stop_s", HUGE_VAL);
  if (motion.start_s < 0) reader.fail("start_s", "must not be negative");
  if (motion.stop_s <= motion.start_s) reader.fail("stop_s", "must come after start_s");
  if (dot(motion.velocity_m_s, motion.velocity_m_s) == 0)
    reader.fail("velocity_m_s", "is zero (leave it out for an obstacle that stands)");
  const bool rises = motion.velocity_m_s.x == 0 && motion.velocity_m_s.y == 0 && motion.velocity_m_s.z > 0;
  if (!rises && motion.stop_s == HUGE_VAL)
    reader.fail("velocity_m_s", "does not point straight up (give stop_s, the time at which the motion ends)");
  return motion;
}

Obstacle parse_obstacle(TomlReader& reader, const Case& c) {
  Obstacle obstacle;
  obstacle.box = parse_box_in_tank(reader, c.tank);
  obstacle.name = reader.text_or("name", "");
  if (obstacle.name == "tank") reader.fail("name", "`tank` names the tank itself (choose another)");
  if (!obstacle.name.empty()) refuse_repeated_name(reader, c.obstacles, obstacle.name);
  obstacle.thin = reader.flag_or("thin", false);
  obstacle.motion = parse_motion(reader);
  reader.finish();
  for (const Box& fluid : c.fluid)
    if (share_volume(obstacle.box, fluid)) reader.fail("", "overlaps the fluid (leave its space out of the fluid)");
  for (const Obstacle& other : c.obstacles)
    if (share_volume(obstacle.box, other.box)) reader.fail("", "overlaps another obstacle (let them touch at most)");
  return obstacle;
}

Vec3d parse_unit_vector(TomlReader& reader, std::string_view key) {
  const Vec3d v = reader.vec3(key);
  const double length = std::sqrt(dot(v, v));
  if (std::abs(length - 1) > 1e-9)
    reader.fail(key, fmt::format("has length {}, must be a unit vector such as [1, 0, 0]", length));
  return v;
}

Placement parse_placement(TomlReader& reader, const Case& c) {
  Placement placement;
  placement.name = reader.text("name");
  refuse_repeated_name(reader, c.placements, placement.name);
  placement.drawn_m = reader.number("drawn_m");
  placement.along = parse_unit_vector(reader, "along");
  placement.moves = reader.texts("moves");
  for (const std::string& moved : placement.moves)
    if (std::none_of(c.obstacles.begin(), c.obstacles.end(), [&](const Obstacle& o) { return o.name == moved; }))
      reader.fail("moves", fmt::format("there is no obstacle `{}` in geometry.obstacles", moved));
  reader.finish();
  return placement;
}

void parse_geometry(TomlReader reader, Case& c) {
  TomlReader tank = reader.table("tank");
  c.tank = parse_box(tank);
  tank.finish();
  for (TomlReader& fluid : reader.tables("fluid")) {
    c.fluid.push_back(parse_box_in_tank(fluid, c.tank));
    fluid.finish();
    for (std::size_t other = 0; other + 1 < c.fluid.size(); ++other)
      if (share_volume(c.fluid.back(), c.fluid[other]))
        fluid.fail("", fmt::format("overlaps geometry.fluid[{}] (let them touch at most)", other));
  }
  for (TomlReader& obstacle : reader.tables("obstacles", true)) c.obstacles.push_back(parse_obstacle(obstacle, c));
  for (TomlReader& placement : reader.tables("placements", true)) c.placements.push_back(parse_placement(placement, c));
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
    if (strictly_inside(c.obstacles[k].box, sensor.position_m))
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

CaseSensor parse_sensor(TomlReader& reader, const Case& c) {
  CaseSensor sensor;
  sensor.name = reader.text("name");
  check_sensor_name(reader, sensor.name, c);
  const std::vector<SensorKind> kinds{SensorKind::pressure, SensorKind::wave_height, SensorKind::force,
                                      SensorKind::velocity};
  std::vector<std::string> kind_names;
  for (const SensorKind kind : kinds) kind_names.emplace_back(to_string(kind));
  const std::string kind = one_of(reader, "kind", kind_names);
  sensor.kind =
      kinds[static_cast<std::size_t>(std::find(kind_names.begin(), kind_names.end(), kind) - kind_names.begin())];
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

void parse_times(TomlReader& root, Case& c) {
  c.t_end_s = root.positive_number("t_end_s");
  c.window = case_parse::parse_window(root, "window_s");
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

WallOption parse_walls(TomlReader& reader, const SolverOption& solver, bool reads_force) {
  WallOption walls;
  walls.name = reader.text("name");
  refuse_repeated_name(reader, solver.walls, walls.name);
  if (reader.has("parameters")) walls.parameters = parse_parameters(reader.table("parameters"), solver.name);
  walls.layers = reader.integer("layers");
  if (walls.layers < 1 || walls.layers > 10)
    reader.fail("layers", fmt::format("is {}, must be 1 to 10 particle layers", walls.layers));
  walls.pressure_model = one_of(reader, "pressure_model", models_of(SensorKind::pressure));
  walls.wave_height_model = one_of(reader, "wave_height_model", models_of(SensorKind::wave_height));
  if (reads_force || reader.has("force_model"))
    walls.force_model = one_of(reader, "force_model", models_of(SensorKind::force));
  reader.finish();
  return walls;
}

SolverOption parse_solver(TomlReader& reader, const Case& c) {
  SolverOption solver;
  solver.name = reader.text("name");
  refuse_repeated_name(reader, c.solvers, solver.name);
  const bool reads_force =
      std::any_of(c.sensors.begin(), c.sensors.end(), [](const CaseSensor& s) { return s.kind == SensorKind::force; });
  for (TomlReader& walls : reader.tables("walls")) solver.walls.push_back(parse_walls(walls, solver, reads_force));
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
  if (root.has("assumptions")) c.assumptions = root.texts("assumptions");
  parse_geometry(root.table("geometry"), c);
  parse_fluid_constants(root, c);
  for (TomlReader& sensor : root.tables("sensors")) c.sensors.push_back(parse_sensor(sensor, c));
  c.measured = root.text_or("measured", "");
  for (const CaseSensor& sensor : c.sensors)
    if (!sensor.measured.empty() && c.measured_file(sensor).empty())
      root.fail("measured",
                fmt::format("is missing, but sensor {} has a measured series (name the digest's file)", sensor.name));
  parse_times(root, c);
  for (TomlReader& solver : root.tables("solvers")) c.solvers.push_back(parse_solver(solver, c));
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
