#include "validation/solver_factory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/mps/mps_solver.h"
#include "solvers/wcsph/wcsph_solver.h"
#include "validation/suggest.h"

namespace sluice {
namespace {

// The largest wave speed of shallow water of the case's depth: sqrt(g H_W).
double wave_speed_m_s(const Case& c) {
  return std::sqrt(-c.gravity_m_s2.z * c.water_height_m);
}

void require_count(const std::map<std::string, double>& p, const char* key, const char* what) {
  constexpr double most = 1e9;
  const double value = p.at(key);
  if (value != std::round(value) || value < 1 || value > most)
    throw std::invalid_argument(fmt::format("{}: is {}, must be a whole number of {}, 1 or more", key, value, what));
}

std::map<std::string, double> complete_wcsph(const Case& c, std::map<std::string, double> p) {
  const wcsph::Parameters defaults;
  p.try_emplace("alpha", defaults.alpha);
  p.try_emplace("delta", defaults.delta);
  p.try_emplace("gamma", defaults.gamma);
  p.try_emplace("courant", defaults.courant);
  p.try_emplace("kernel_radius_over_distance", defaults.kernel_radius_over_distance);
  p.try_emplace("restart_interval", defaults.restart_interval);
  p.try_emplace("tension_limit", defaults.tension_limit);
  p.try_emplace("wall_friction", defaults.wall_friction);
  p.try_emplace("speed_of_sound_over_sqrt_gH", 20.0);
  // A speed of sound given in m/s counts; the ratio then follows it.
  if (!p.contains("speed_of_sound_m_s")) p["speed_of_sound_m_s"] = p["speed_of_sound_over_sqrt_gH"] * wave_speed_m_s(c);
  p["speed_of_sound_over_sqrt_gH"] = p["speed_of_sound_m_s"] / wave_speed_m_s(c);
  require_count(p, "restart_interval", "steps");
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
  p.tension_limit = given.at("tension_limit");
  p.wall_friction = given.at("wall_friction");
  p.reference_density_kg_m3 = c.density_kg_m3;
  p.water_height_m = c.water_height_m;
  p.gravity_m_s2 = c.gravity_m_s2;
  p.walls = settings.walls == "dynamic" ? wcsph::WallModel::dynamic : wcsph::WallModel::extrapolated;
  return make_wcsph_solver(scene, p, settings.threads);
}

// Memory: the solver's own target is 200 bytes a particle. The mean time step is shorter than Cr h / c0, for the
// velocity differences between neighbours: the paper's Table 1 gives 3.8e-5 s where Cr h / c0 is 4.84e-5 s. Rates:
// fluid particle-steps a second and thread, whole steps in disordered flow at l0 = 0.02 m; bench/ measures them.
SolverCost wcsph_cost(const RunSettings& settings) {
  const auto& p = settings.parameters;
  const double h_m = 0.5 * p.at("kernel_radius_over_distance") * settings.l0_m;
  const double rate = settings.walls == "dynamic" ? 3.2e6 : 2.6e6;
  return {200, 0.8 * p.at("courant") * h_m / p.at("speed_of_sound_m_s"), rate, 1, 0.4};
}

std::map<std::string, double> complete_mps(const Case&, std::map<std::string, double> p) {
  const mps::Parameters defaults;
  p.try_emplace("effective_radius_over_distance", defaults.effective_radius_over_distance);
  p.try_emplace("viscosity_m2_s", defaults.viscosity_m2_s);
  p.try_emplace("kappa_c_m_s2_kg", defaults.kappa_c_m_s2_kg);
  p.try_emplace("kappa_r", defaults.kappa_r);
  p.try_emplace("tolerated_crowding", defaults.tolerated_crowding);
  p.try_emplace("courant", defaults.courant);
  p.try_emplace("greatest_speed_m_s", defaults.greatest_speed_m_s);
  p.try_emplace("collision_over_distance", defaults.collision_over_distance);
  p.try_emplace("restitution", defaults.restitution);
  p.try_emplace("wall_contact_over_distance", defaults.wall_contact_over_distance);
  p.try_emplace("tolerance", defaults.tolerance);
  p.try_emplace("most_iterations", defaults.most_iterations);
  require_count(p, "most_iterations", "iterations");
  p.try_emplace("multigrid", 1.0);
  if (p["multigrid"] != 0 && p["multigrid"] != 1)
    throw std::invalid_argument(fmt::format("multigrid: is {}, must be 1 (or 0 for Jacobi)", p["multigrid"]));
  for (const char* key : {"courant", "greatest_speed_m_s"})
    if (p[key] <= 0) throw std::invalid_argument(fmt::format("{}: is {}, must be greater than zero", key, p[key]));
  return p;
}

mps::Parameters mps_parameters(const RunSettings& settings) {
  const auto& given = settings.parameters;
  mps::Parameters p;
  p.particle_distance_m = settings.l0_m;
  p.effective_radius_over_distance = given.at("effective_radius_over_distance");
  p.viscosity_m2_s = given.at("viscosity_m2_s");
  p.kappa_c_m_s2_kg = given.at("kappa_c_m_s2_kg");
  p.kappa_r = given.at("kappa_r");
  p.tolerated_crowding = given.at("tolerated_crowding");
  p.courant = given.at("courant");
  p.greatest_speed_m_s = given.at("greatest_speed_m_s");
  p.collision_over_distance = given.at("collision_over_distance");
  p.restitution = given.at("restitution");
  p.wall_contact_over_distance = given.at("wall_contact_over_distance");
  p.tolerance = given.at("tolerance");
  p.most_iterations = static_cast<int>(given.at("most_iterations"));
  p.preconditioner = given.at("multigrid") == 1 ? mps::Preconditioner::multigrid : mps::Preconditioner::jacobi;
  return p;
}

std::unique_ptr<Solver> make_mps(const Case& c, const Scene& scene, const RunSettings& settings) {
  mps::Parameters p = mps_parameters(settings);
  p.density_kg_m3 = c.density_kg_m3;
  p.gravity_m_s2 = c.gravity_m_s2;
  return make_mps_solver(scene, p, settings.threads);
}

// Memory: the solver's target. Rate: of one of two threads over whole runs, 0.33e6 to 0.65e6 by the processor and by
// how much of what is solved is wall. The pressure equation waits for memory, so that many threads do less than this
// says. A whole run over its first steps, in which all water stands at depth and in order: 0.73 to 0.89 on EPYC
// 25/17/1, 1.09 to 1.14 on 23/1/2, 1.1 to 1.2 on 25/1/1.
SolverCost mps_cost(const RunSettings& settings) {
  return {700, mps_parameters(settings).time_step_s(), 0.45e6, 0.94, 0.1};
}

// One entry a solver: a new one is added here and nowhere else in the harness.
struct SolverEntry {
  std::string name;
  std::vector<std::string> walls;
  std::string wall_pressure_model;
  std::vector<std::string> parameters;
  std::map<std::string, double> (*complete)(const Case&, std::map<std::string, double>);
  std::unique_ptr<Solver> (*make)(const Case&, const Scene&, const RunSettings&);
  SolverCost (*cost)(const RunSettings&);
};

const std::vector<SolverEntry>& entries() {
  static const std::vector<SolverEntry> all{
      {"wcsph",
       {"extrapolated", "dynamic"},
       "wall",
       {"alpha", "delta", "gamma", "courant", "kernel_radius_over_distance", "restart_interval", "speed_of_sound_m_s",
        "speed_of_sound_over_sqrt_gH", "tension_limit", "wall_friction"},
       complete_wcsph,
       make_wcsph,
       wcsph_cost},
      {"mps",
       {"dummies"},
       "nearest",
       {"effective_radius_over_distance", "viscosity_m2_s", "kappa_c_m_s2_kg", "kappa_r", "tolerated_crowding",
        "courant", "greatest_speed_m_s", "collision_over_distance", "restitution", "wall_contact_over_distance",
        "tolerance", "most_iterations", "multigrid"},
       complete_mps,
       make_mps,
       mps_cost}};
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

bool has_solver(std::string_view solver) {
  return find_entry(solver) != nullptr;
}

std::vector<std::string> solver_parameter_names(std::string_view solver) {
  const SolverEntry* entry = find_entry(solver);
  return entry == nullptr ? std::vector<std::string>{} : entry->parameters;
}

std::string wall_pressure_model(std::string_view solver) {
  const SolverEntry* entry = find_entry(solver);
  return entry == nullptr ? "wall" : entry->wall_pressure_model;
}

std::map<std::string, double> complete_parameters(const Case& c, std::string_view solver,
                                                  const std::map<std::string, double>& given) {
  const SolverEntry& entry = require_entry(solver);
  for (const auto& [key, value] : given) {
    const bool known = c.find_placement(key) != nullptr ||
                       std::find(entry.parameters.begin(), entry.parameters.end(), key) != entry.parameters.end();
    if (!known)
      throw std::invalid_argument(
          fmt::format("{}: unknown parameter of solver {}{}", key, solver, suggestion(key, entry.parameters)));
    if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{}: is not a finite number", key));
  }
  return entry.complete(c, given);
}

std::optional<double> equivalent_viscosity_m2_s(const RunSettings& settings) {
  const auto& p = settings.parameters;
  if (p.contains("viscosity_m2_s")) return p.at("viscosity_m2_s");
  if (!p.contains("alpha") || !p.contains("speed_of_sound_m_s")) return std::nullopt;
  const double h_m = 0.5 * p.at("kernel_radius_over_distance") * settings.l0_m;
  return p.at("alpha") * h_m * p.at("speed_of_sound_m_s") / (2 * (3 + 2));
}

SolverCost solver_cost(const RunSettings& settings) {
  return require_entry(settings.solver).cost(settings);
}

std::unique_ptr<Solver> make_solver(const Case& c, const Scene& scene, const RunSettings& settings) {
  const SolverEntry& entry = require_entry(settings.solver);
  if (std::find(entry.walls.begin(), entry.walls.end(), settings.walls) == entry.walls.end())
    throw std::invalid_argument(fmt::format("walls: solver {} of this program has no wall model `{}`{}", entry.name,
                                            settings.walls, suggestion(settings.walls, entry.walls)));
  return entry.make(c, scene, settings);
}

}  // namespace sluice
