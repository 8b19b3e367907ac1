#include "validation/run_settings.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "validation/solver_factory.h"
#include "validation/suggest.h"

namespace sluice {
namespace {

// Snapshots by the thousand fill disks by accident.
constexpr double most_snapshots = 10000;

template <class T>
std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.push_back(item.name);
  return names;
}

const SolverOption& choose_solver(const Case& c, const std::string& name) {
  const SolverOption* option = c.find_solver(name.empty() ? c.default_solver : name);
  if (option == nullptr)
    throw std::invalid_argument(
        fmt::format("solver: case {} has no solver `{}`{}", c.name, name, suggestion(name, names_of(c.solvers))));
  return *option;
}

const WallOption& choose_walls(const SolverOption& solver, const std::string& name) {
  const WallOption* walls = find_walls(solver, name.empty() ? solver.default_walls : name);
  if (walls == nullptr)
    throw std::invalid_argument(fmt::format("walls: solver {} has no wall model `{}`{}", solver.name, name,
                                            suggestion(name, names_of(solver.walls))));
  return *walls;
}

double choose_l0(const Case& c, const RunRequest& request) {
  const Tier* tier = c.find_tier("standard");
  const double l0_m = request.l0_m.value_or(tier != nullptr ? tier->l0_m : c.tiers.front().l0_m);
  if (const std::string problem = particle_distance_problem(c, l0_m); !problem.empty())
    throw std::invalid_argument("l0: " + problem);
  return l0_m;
}

void apply_override(const Case& c, RunSettings& settings, const std::string& key, double value) {
  if (key == "t_end_s" || key == "output_rate_Hz") {
    if (value <= 0) throw std::invalid_argument(fmt::format("{}: is {}, must be greater than zero", key, value));
    (key == "t_end_s" ? settings.t_end_s : settings.output_rate_Hz) = value;
    return;
  }
  std::vector<std::string> known = solver_parameter_names(settings.solver);
  for (const Placement& placement : c.placements) known.push_back(placement.name);
  if (std::find(known.begin(), known.end(), key) != known.end()) {
    settings.parameters[key] = value;
    return;
  }
  known.insert(known.begin(), {"t_end_s", "output_rate_Hz"});
  throw std::invalid_argument(fmt::format("{}: unknown parameter of solver {}{}; known: {}", key, settings.solver,
                                          closest(key, known) ? suggestion(key, known) : "", fmt::join(known, ", ")));
}

std::vector<double> choose_snapshots(const Case& c, const RunRequest& request, double t_end_s) {
  std::vector<double> times;
  if (request.snapshot_every_s > 0) {
    if (t_end_s / request.snapshot_every_s > most_snapshots)
      throw std::invalid_argument(fmt::format("snapshot-every: {} s would write {:.0f} snapshots (at most {:.0f})",
                                              request.snapshot_every_s, t_end_s / request.snapshot_every_s,
                                              most_snapshots));
    const auto count = static_cast<int>(t_end_s / request.snapshot_every_s * (1 + 1e-12));
    for (int k = 0; k <= count; ++k) times.push_back(k * request.snapshot_every_s);
  } else if (request.snapshots) {
    times = c.snapshot_times_s;
    std::sort(times.begin(), times.end());
  }
  std::erase_if(times, [&](double t) { return t > t_end_s; });
  return times;
}

void refuse_collision(const SceneDescription& d, const std::string& name, double value) {
  const auto fail = [&](std::string_view why) {
    throw std::invalid_argument(fmt::format("{}: {} m puts an obstacle {}; choose another value", name, value, why));
  };
  for (std::size_t k = 0; k < d.obstacles.size(); ++k) {
    const Box& box = d.obstacles[k].box;
    if (!holds_point(d.tank, box.lower) || !holds_point(d.tank, box.upper)) fail("outside of the tank");
    for (const Box& fluid : d.fluid)
      if (share_volume(box, fluid)) fail("into the fluid");
    for (std::size_t other = 0; other < k; ++other)
      if (share_volume(box, d.obstacles[other].box)) fail("into another one");
  }
}

}  // namespace

SceneDescription scene_description(const Case& c, const RunSettings& settings) {
  SceneDescription d = scene_description(c, settings.l0_m, settings.wall_layers);
  for (const Placement& placement : c.placements) {
    const auto chosen = settings.parameters.find(placement.name);
    if (chosen == settings.parameters.end() || chosen->second == placement.drawn_m) continue;
    place(d.obstacles, placement, chosen->second);
    refuse_collision(d, placement.name, chosen->second);
  }
  return d;
}

RunSettings resolve_settings(const Case& c, const RunRequest& request) {
  const SolverOption& solver = choose_solver(c, request.solver);
  const WallOption& walls = choose_walls(solver, request.walls);
  RunSettings settings;
  settings.solver = solver.name;
  settings.walls = walls.name;
  settings.wall_layers = walls.layers;
  settings.l0_m = choose_l0(c, request);
  settings.t_end_s = c.t_end_s;
  settings.output_rate_Hz = c.output_rate_Hz;
  if (request.threads < 0)
    throw std::invalid_argument("threads: must be 1 or more (or 0 for OMP_NUM_THREADS, else all processors)");
  settings.threads = request.threads > 0 ? request.threads : omp_get_max_threads();
  settings.parameters = solver.parameters;
  for (const auto& [key, value] : walls.parameters) settings.parameters[key] = value;
  for (const Placement& placement : c.placements) settings.parameters[placement.name] = placement.drawn_m;
  for (const auto& [key, value] : request.overrides) apply_override(c, settings, key, value);
  settings.parameters = complete_parameters(c, settings.solver, settings.parameters);
  scene_description(c, settings);  // refuses a placement that cannot be
  settings.snapshot_times_s = choose_snapshots(c, request, settings.t_end_s);
  return settings;
}

std::pair<std::string, double> parse_override(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw std::invalid_argument(fmt::format("`{}`: is not key=value (such as t_end_s=0.1)", text));
  const std::string key = text.substr(0, equals);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + equals + 1, end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{}: `{}` is not a number", key, text.substr(equals + 1)));
  return {key, value};
}

std::filesystem::path default_run_directory(const Case& c, const RunSettings& settings) {
  std::string name = fmt::format("{}-{}-{}-l{}", c.name, settings.solver, settings.walls, settings.l0_m);
  // 0.02 and 0.015 line up in a listing as 0.020 and 0.015.
  if (const std::string padded = fmt::format("{:.3f}", settings.l0_m);
      std::abs(std::stod(padded) - settings.l0_m) < 1e-12)
    name = fmt::format("{}-{}-{}-l{}", c.name, settings.solver, settings.walls, padded);
  if (const auto alpha = settings.parameters.find("alpha"); alpha != settings.parameters.end())
    name += fmt::format("-alpha{}", alpha->second);
  return std::filesystem::path("runs") / name;
}

}  // namespace sluice
