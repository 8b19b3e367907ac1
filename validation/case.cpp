#include "validation/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "validation/manifest.h"
#include "validation/suggest.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

template <class T>
const T* find_named(const std::vector<T>& items, std::string_view name) {
  auto found = std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

double shortest_side(const Box& box) {
  return std::min({box.upper.x - box.lower.x, box.upper.y - box.lower.y, box.upper.z - box.lower.z});
}

struct KindFacts {
  std::string_view name;
  std::string_view unit;
  std::vector<std::string> models;
};

const KindFacts& facts_of(SensorKind kind) {
  static const std::map<SensorKind, KindFacts> facts{
      {SensorKind::pressure, {"pressure", "Pa", {"wall", "kernel", "nearest"}}},
      {SensorKind::wave_height, {"wave_height", "m", {"column", "top"}}},
      {SensorKind::force, {"force", "N", {"acceleration", "pressure"}}},
      {SensorKind::velocity, {"velocity", "m_s", {"kernel"}}},
  };
  return facts.at(kind);
}

}  // namespace

const std::vector<SensorKind>& sensor_kinds() {
  static const std::vector<SensorKind> kinds{SensorKind::pressure, SensorKind::wave_height, SensorKind::force,
                                             SensorKind::velocity};
  return kinds;
}

std::string_view to_string(SensorKind kind) {
  return facts_of(kind).name;
}

std::string_view unit_of(SensorKind kind) {
  return facts_of(kind).unit;
}

const std::vector<std::string>& models_of(SensorKind kind) {
  return facts_of(kind).models;
}

std::string probe_column(const CaseSensor& sensor, std::string_view model) {
  std::string name = sensor.name;
  if (!model.empty()) name.append("_").append(model);
  return name.append("_").append(unit_of(sensor.kind));
}

const std::vector<AcceptanceMetric>& acceptance_metrics() {
  static const std::vector<AcceptanceMetric> metrics{
      {"impulse_deviation", "1", true, "impulse over the window, (simulated - measured) / measured"},
      {"arrival_difference_s", "s", true, "arrival at 10 % of the measured peak, simulated - measured"},
      {"half_peak_time_difference_s", "s", true, "first time at half of the measured peak, simulated - measured"},
      {"peak_deviation", "1", true, "largest value, (simulated - measured) / measured"},
      {"smoothed_peak_deviation", "1", true, "the same after a 10 ms running mean of both series"},
      {"peak_time_difference_s", "s", true, "time of the largest value, simulated - measured"},
      {"rmse_over_range", "1", true, "root mean square difference over the window / measured range"},
      {"lag_s", "s", true, "shift of best correlation; positive: the simulation is late"},
      {"share_inside_band", "1", true, "share of the window's time inside the measured band"},
      {"lost_through_walls", "particles", false, "fluid particles that passed a wall"},
      {"lost_over_top_share", "1", false, "fluid particles that left over the open top / all at the start"},
      {"number_density_max_over_n0", "n0", false, "MPS: number density of the densest particle of the whole run"},
      {"fluid_volume_deviation", "1", false, "(volume on the lattice - nominal) / nominal, at the start"},
  };
  return metrics;
}

const Placement* Case::find_placement(std::string_view placement_name) const {
  return find_named(placements, placement_name);
}
const CaseSensor* Case::find_sensor(std::string_view sensor_name) const {
  return find_named(sensors, sensor_name);
}
const SolverOption* Case::find_solver(std::string_view solver_name) const {
  return find_named(solvers, solver_name);
}
const Tier* Case::find_tier(std::string_view tier_name) const {
  return find_named(tiers, tier_name);
}

const std::filesystem::path& Case::measured_file(const CaseSensor& sensor) const {
  static const std::filesystem::path none;
  if (sensor.measured.empty()) return none;
  return sensor.measured_in.empty() ? measured : sensor.measured_in;
}

const WallOption* find_walls(const SolverOption& solver, std::string_view walls) {
  return find_named(solver.walls, walls);
}

std::string primary_model(const Case& c, const CaseSensor& sensor, std::string_view solver, std::string_view walls) {
  const SolverOption* option = c.find_solver(solver);
  if (option == nullptr) throw std::invalid_argument(fmt::format("case {} has no solver `{}`", c.name, solver));
  const WallOption* wall = find_walls(*option, walls);
  if (wall == nullptr) throw std::invalid_argument(fmt::format("solver {} has no wall model `{}`", solver, walls));
  switch (sensor.kind) {
    case SensorKind::pressure:
      return wall->pressure_model;
    case SensorKind::wave_height:
      return wall->wave_height_model;
    case SensorKind::force:
      return wall->force_model;
    case SensorKind::velocity:
      break;
  }
  return "kernel";
}

std::string particle_distance_problem(const Case& c, double l0_m) {
  if (!(l0_m > 0)) return "must be greater than zero";
  double deepest = 0;
  for (const Box& fluid : c.fluid) {
    deepest = std::max(deepest, shortest_side(fluid));
    // A layer that is thinner than a particle is one particle deep, if that is not too far from the truth.
    if (l0_m > 1.3 * shortest_side(fluid))
      return fmt::format("is {} m, too large for a layer of fluid {:g} m thin (use {:g} m or less)", l0_m,
                         shortest_side(fluid), std::floor(1.3e4 * shortest_side(fluid)) / 1e4);
  }
  double shortest = std::min(shortest_side(c.tank), deepest);
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.thin) shortest = std::min(shortest, shortest_side(obstacle.box));
  if (3 * l0_m <= shortest * (1 + 1e-9)) return "";
  return fmt::format("is {} m, too large for a length of {:g} m in the geometry (use {:g} m or less)", l0_m, shortest,
                     std::floor(1e4 * shortest / 3) / 1e4);
}

void place(std::vector<Obstacle>& obstacles, const Placement& placement, double value_m) {
  const Vec3d by = (value_m - placement.drawn_m) * placement.along;
  for (Obstacle& o : obstacles)
    if (std::find(placement.moves.begin(), placement.moves.end(), o.name) != placement.moves.end())
      o.box = shifted(o.box, by);
}

SceneDescription scene_description(const Case& c, double l0_m, int wall_layers) {
  return {c.tank, c.fluid, c.obstacles, l0_m, wall_layers, c.gravity_m_s2, c.density_kg_m3};
}

std::filesystem::path resolve_in_source_tree(const std::filesystem::path& path) {
  if (path.is_absolute() || std::filesystem::exists(path)) return path;
  const std::filesystem::path in_source = build_info().source_root / path;
  return std::filesystem::exists(in_source) ? in_source : path;
}

std::filesystem::path case_directory() {
  return resolve_in_source_tree("validation/cases");
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(case_directory(), ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Case load_case(const std::string& name_or_path) {
  std::filesystem::path file = name_or_path;
  if (file.extension() != ".toml") {
    file = case_directory() / (name_or_path + ".toml");
    if (!std::filesystem::exists(file))
      throw CaseError(fmt::format("no case `{}` in {}{}", name_or_path, case_directory().string(),
                                  suggestion(name_or_path, case_names())));
  }
  return parse_case(read_text(file, "give the name of a case or the path of its TOML file"), file.string());
}

bool has_inputs_of(const Case& c, std::string_view computed_hash, std::string_view hash) {
  return hash == c.hash || (!computed_hash.empty() && computed_hash == c.computed_hash);
}

std::string outside_case_file(const Case& c) {
  std::error_code error;
  const std::filesystem::path own = case_directory() / (c.name + ".toml");
  if (std::filesystem::equivalent(own, c.file, error)) return "";
  return std::filesystem::absolute(c.file).lexically_normal().string();
}

}  // namespace sluice
