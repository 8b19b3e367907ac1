#include "validation/run_cost.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "validation/legs.h"
#include "validation/manifest.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_directories = 1000;
constexpr int most_entries = 10'000;  // of one directory: neighbours may be anything

std::string all_but_alpha(json parameters) {
  if (parameters.is_object()) parameters.erase("alpha");
  return parameters.dump();
}

double alpha_of(const json& parameters) {
  return parameters.is_object() && parameters.contains("alpha") ? parameters.at("alpha").get<double>() : 0.0;
}

/// A decade of alpha moves the number of steps about as much as the rule for l0 errs over half an octave.
double decades_apart(double alpha, double other) {
  return alpha > 0 && other > 0 ? std::abs(std::log10(alpha / other)) : 0.0;
}

/// Throws json::exception where a key is missing or is something else.
std::optional<RunCost> cost_of(const json& m, const std::string& machine) {
  if (m.at("status") != "finished" || m.at("machine") != machine || !difference_of_legs(m).empty()) return std::nullopt;
  RunCost cost;
  cost.case_hash = m.at("case_hash");
  cost.computed_hash = m.value("computed_hash", "");
  cost.solver = m.at("solver");
  cost.walls = m.at("walls");
  cost.parameters = all_but_alpha(m.at("parameters"));
  cost.alpha = alpha_of(m.at("parameters"));
  cost.threads = m.at("threads");
  cost.l0_m = m.at("l0_m");
  cost.time_s = m.at("time_s");
  cost.steps = m.at("steps");
  cost.fluid = m.at("particles").at("fluid");
  cost.solid = m.at("particles").value("solid", 0.0);
  cost.wall_time_s = m.at("wall_time_s");
  const bool makes_sense = cost.l0_m > 0 && cost.time_s > 0 && cost.steps > 0 && cost.fluid > 0 && cost.wall_time_s > 0;
  return makes_sense ? std::optional(cost) : std::nullopt;
}

bool is_of_case(const RunCost& cost, const Case& c) {
  return has_inputs_of(c, cost.computed_hash, cost.case_hash);
}

/// In the order of their names; none where there is no such directory.
std::vector<fs::path> subdirectories(const fs::path& directory) {
  std::vector<fs::path> found;
  std::error_code none;
  int entries = 0;
  for (fs::directory_iterator it(directory, none), end; !none && it != end && entries < most_entries; ++entries) {
    if (std::error_code broken; it->is_directory(broken)) found.push_back(it->path());
    it.increment(none);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool is_of_kind(const RunCost& cost, const RunSettings& settings) {
  return cost.solver == settings.solver && cost.walls == settings.walls && cost.threads == settings.threads;
}

std::vector<RunCost> run_costs(const std::vector<fs::path>& directories) {
  std::vector<RunCost> costs;
  const std::string machine = machine_fingerprint();
  for (const fs::path& directory : directories) {
    std::ifstream in(directory / "run.json");
    if (!in) continue;
    try {
      if (const auto cost = cost_of(json::parse(in), machine)) costs.push_back(*cost);
    } catch (const json::exception&) {
      continue;  // no manifest of ours: nothing to reckon by
    }
  }
  return costs;
}

std::vector<fs::path> runs_near(const fs::path& directory) {
  std::vector<fs::path> found;
  const auto take = [&](const fs::path& candidate) {
    std::error_code none;
    if (found.size() < most_directories && fs::exists(candidate / "run.json", none)) found.push_back(candidate);
  };
  const fs::path parent = directory.parent_path();
  for (const fs::path& neighbour : subdirectories(parent.empty() ? "." : parent)) {
    take(neighbour);
    for (const fs::path& below : subdirectories(neighbour)) take(below);
  }
  return found;
}

void reckon_by(const std::vector<RunCost>& costs, const Case& c, const RunSettings& s, Plan& plan) {
  const RunCost* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const double alpha = alpha_of(s.parameters);
  const std::string parameters = all_but_alpha(s.parameters);
  for (const RunCost& cost : costs) {
    if (!is_of_kind(cost, s)) continue;
    const double apart = std::abs(std::log(cost.l0_m / s.l0_m)) + 0.35 * decades_apart(cost.alpha, alpha) +
                         (cost.parameters == parameters || cost.probed ? 0.0 : 1.0) +
                         (is_of_case(cost, c) ? 0.0 : 10.0) + (cost.probed ? 5.0 : 0.0);
    if (apart >= least) continue;
    least = apart;
    nearest = &cost;
  }
  if (nearest == nullptr) return;
  if (is_of_case(*nearest, c) && nearest->parameters == parameters) {
    plan.steps = nearest->steps * (nearest->l0_m / s.l0_m) * (s.t_end_s / nearest->time_s);
    plan.dt_s = s.t_end_s / plan.steps;
  }
  const double share = solver_cost(s).solid_over_fluid;
  const double load = static_cast<double>(plan.particles.fluid) + share * static_cast<double>(plan.particles.solid);
  const double load_steps_per_s = (nearest->fluid + share * nearest->solid) * nearest->steps / nearest->wall_time_s;
  plan.wall_time_s = load * plan.steps / load_steps_per_s;
  plan.basis = nearest->probed ? PlanBasis::probe : PlanBasis::run;
}

Plan plan_near(const Case& c, const RunSettings& settings, const fs::path& directory) {
  Plan plan = plan_run(c, settings);
  reckon_by(run_costs(runs_near(directory)), c, settings, plan);
  return plan;
}

}  // namespace sluice
