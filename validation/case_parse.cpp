// From TOML to a Case. Every check stands where its value is read, so that its message can name the line.
#include "validation/case_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/case.h"
#include "validation/computed_hash.h"
#include "validation/file_hash.h"
#include "validation/solver_factory.h"
#include "validation/suggest.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

using case_parse::inside;
using case_parse::names_of;
using case_parse::one_of;
using case_parse::parse_unit_vector;
using case_parse::refuse_repeated_name;

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
  if (std::abs(highest - c.water_height_m) > drawn_tolerance_m)
    root.fail("water_height_m",
              fmt::format("is {} m, but the fluid in geometry.fluid stands {} m high (make them agree)",
                          c.water_height_m, highest));
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

/// Our own solvers read walls in one way each; another code's results may have been read in any.
std::vector<std::string> pressure_models(const std::string& solver) {
  if (!has_solver(solver)) return models_of(SensorKind::pressure);
  return {wall_pressure_model(solver), "kernel"};
}

WallOption parse_walls(TomlReader& reader, const SolverOption& solver, bool reads_force) {
  WallOption walls;
  walls.name = reader.text("name");
  refuse_repeated_name(reader, solver.walls, walls.name);
  if (reader.has("parameters")) walls.parameters = parse_parameters(reader.table("parameters"), solver.name);
  walls.layers = reader.integer("layers");
  if (walls.layers < 1 || walls.layers > 10)
    reader.fail("layers", fmt::format("is {}, must be 1 to 10 particle layers", walls.layers));
  walls.pressure_model = one_of(reader, "pressure_model", pressure_models(solver.name));
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
  for (TomlReader& sensor : root.tables("sensors")) c.sensors.push_back(case_parse::parse_sensor(sensor, c));
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
  c.hash = text_hash(text);
  c.computed_hash = computed_hash(table);
  return c;
}

}  // namespace sluice
