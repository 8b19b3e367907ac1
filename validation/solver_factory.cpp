#include "validation/solver_factory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/wcsph/wcsph_solver.h"
#include "validation/suggest.h"

namespace sluice {
namespace {

// The largest wave speed of shallow water of the case's depth: sqrt(g H_W).
double wave_speed_m_s(const Case& c) {
  return std::sqrt(-c.gravity_m_s2.z * c.water_height_m);
}

std::map<std::string, double> complete_wcsph(const Case& c, std::map<std::string, double> p) {
  const wcsph::Parameters defaults;
  p.try_emplace("alpha", defaults.alpha);
  p.try_emplace("delta", defaults.delta);
  p.try_emplace("gamma", defaults.gamma);
  p.try_emplace("courant", defaults.courant);
  p.try_emplace("kernel_radius_over_distance", defaults.kernel_radius_over_distance);
  p.try_emplace("restart_interval", defaults.restart_interval);
  p.try_emplace("speed_of_sound_over_sqrt_gH", 20.0);
  // A speed of sound given in m/s counts; the ratio then follows it.
  if (!p.contains("speed_of_sound_m_s")) p["speed_of_sound_m_s"] = p["speed_of_sound_over_sqrt_gH"] * wave_speed_m_s(c);
  p["speed_of_sound_over_sqrt_gH"] = p["speed_of_sound_m_s"] / wave_speed_m_s(c);
  if (p["restart_interval"] != std::round(p["restart_interval"]) || p["restart_interval"] < 1)
    throw std::invalid_argument(
        fmt::format("restart_interval: is {}, must be a whole number of steps, 1 or more", p["restart_interval"]));
  if (p["speed_of_sound_m_s"] <= 0)
    throw std::invalid_argument(
        fmt::format("speed_of_sound_m_s: is {}, must be greater than zero", p["speed_of_sound_m_s"]));
  if (p["courant"] <= 0 || p["courant"] > 1)
    throw std::invalid_argument(fmt::format("courant: is {}, must be above 0 and at most 1", p["courant"]));
  return p;
}

std::unique_ptr<Solver> make_wcsph(const Case& c, const Scene& scene, const RunSettings& settings) {
  const auto& given = settings.parameters;
  wcsph::Parameters p;
  p.particle_distance_m = settings.l0_m;
  p.kernel_radius_over_distance = given.at("kernel_radius_over_distance");
  p.alpha = given.at("alpha");
  p.delta = given.at("delta");
  p.gamma = given.at("gamma");
  p.courant = given.at("courant");
  p.speed_of_sound_m_s = given.at("speed_of_sound_m_s");
  p.restart_interval = static_cast<int>(given.at("restart_interval"));
  p.reference_density_kg_m3 = c.density_kg_m3;
  p.water_height_m = c.water_height_m;
  p.gravity_m_s2 = c.gravity_m_s2;
  p.walls = settings.walls == "dynamic" ? wcsph::WallModel::dynamic : wcsph::WallModel::extrapolated;
  return make_wcsph_solver(scene, p, settings.threads);
}

// One entry a solver: a new one is added here and nowhere else in the harness.
struct SolverEntry {
  std::string name;
  std::vector<std::string> walls;
  std::vector<std::string> parameters;
  std::map<std::string, double> (*complete)(const Case&, std::map<std::string, double>);
  std::unique_ptr<Solver> (*make)(const Case&, const Scene&, const RunSettings&);
};

const std::vector<SolverEntry>& entries() {
  static const std::vector<SolverEntry> all{{"wcsph",
                                             {"extrapolated", "dynamic"},
                                             {"alpha", "delta", "gamma", "courant", "kernel_radius_over_distance",
                                              "restart_interval", "speed_of_sound_m_s", "speed_of_sound_over_sqrt_gH"},
                                             complete_wcsph,
                                             make_wcsph}};
  return all;
}

const SolverEntry* find_entry(std::string_view solver) {
  for (const SolverEntry& entry : entries())
    if (entry.name == solver) return &entry;
  return nullptr;
}

const SolverEntry& require_entry(std::string_view solver) {
  if (const SolverEntry* entry = find_entry(solver)) return *entry;
  throw std::invalid_argument(
      fmt::format("solver: this program has no solver `{}`{}", solver, suggestion(solver, solver_names())));
}

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SolverEntry& entry : entries()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

std::vector<std::string> solver_parameter_names(std::string_view solver) {
  const SolverEntry* entry = find_entry(solver);
  return entry == nullptr ? std::vector<std::string>{} : entry->parameters;
}

std::map<std::string, double> complete_parameters(const Case& c, std::string_view solver,
                                                  const std::map<std::string, double>& given) {
  const SolverEntry& entry = require_entry(solver);
  for (const auto& [key, value] : given) {
    if (std::find(entry.parameters.begin(), entry.parameters.end(), key) == entry.parameters.end())
      throw std::invalid_argument(
          fmt::format("{}: unknown parameter of solver {}{}", key, solver, suggestion(key, entry.parameters)));
    if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{}: is not a finite number", key));
  }
  return entry.complete(c, given);
}

std::optional<double> equivalent_viscosity_m2_s(const RunSettings& settings) {
  const auto& p = settings.parameters;
  if (!p.contains("alpha") || !p.contains("speed_of_sound_m_s")) return std::nullopt;
  const double h_m = 0.5 * p.at("kernel_radius_over_distance") * settings.l0_m;
  return p.at("alpha") * h_m * p.at("speed_of_sound_m_s") / (2 * (3 + 2));
}

std::unique_ptr<Solver> make_solver(const Case& c, const Scene& scene, const RunSettings& settings) {
  const SolverEntry& entry = require_entry(settings.solver);
  if (std::find(entry.walls.begin(), entry.walls.end(), settings.walls) == entry.walls.end())
    throw std::invalid_argument(fmt::format("walls: solver {} of this program has no wall model `{}`{}", entry.name,
                                            settings.walls, suggestion(settings.walls, entry.walls)));
  return entry.make(c, scene, settings);
}

}  // namespace sluice
