#include "validation/rate_probe.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>

#include "validation/solver_factory.h"

namespace sluice {
namespace {

constexpr int steps_to_warm_up = 3;
constexpr int fewest_steps = 5;
constexpr double probe_s = 1;
constexpr double longest_probe_s = 10;  // whatever else the machine does: a rough time is better than none for minutes
constexpr double worth_a_probe_s = 20;
constexpr std::int64_t most_particles = 300'000;

double elapsed_s(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The settings with the finest particle distance, among the run's own and the case's coarser tiers, that few enough
/// particles go with; nullopt where there is none.
std::optional<RunSettings> affordable(const Case& c, RunSettings settings) {
  std::vector<double> distances_m{settings.l0_m};
  for (const Tier& tier : c.tiers)
    if (tier.l0_m > settings.l0_m) distances_m.push_back(tier.l0_m);
  std::sort(distances_m.begin(), distances_m.end());
  for (const double l0_m : distances_m) {
    settings.l0_m = l0_m;
    const ParticleCounts particles = count_particles(scene_description(c, settings));
    if (particles.fluid + particles.solid <= most_particles) return settings;
  }
  return std::nullopt;
}

/// Adds the probe of a run, where it has one and its like is not there yet.
void probe_into(std::vector<RunCost>& probed, const Case& c, const RunSettings& settings) {
  try {
    const std::optional<RunSettings> probe = affordable(c, settings);
    const auto twin = [&](const RunCost& cost) {
      return cost.probed && is_of_kind(cost, *probe) && cost.case_hash == c.hash && cost.l0_m == probe->l0_m;
    };
    if (probe && std::none_of(probed.begin(), probed.end(), twin)) probed.push_back(probe_cost(c, *probe));
  } catch (const std::exception&) {
    return;  // whatever it is, the run itself will tell, and the others go on
  }
}

}  // namespace

RunCost probe_cost(const Case& c, const RunSettings& settings) {
  const auto solver = make_solver(c, build_scene(scene_description(c, settings)), settings);
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < steps_to_warm_up && elapsed_s(start) < longest_probe_s; ++k) solver->step();
  const std::int64_t warmed_up = solver->steps();
  const auto begin = std::chrono::steady_clock::now();
  do {
    solver->step();
  } while ((solver->steps() < warmed_up + fewest_steps || elapsed_s(begin) < probe_s) &&
           elapsed_s(start) < longest_probe_s);
  RunCost cost;
  cost.case_hash = c.hash;
  cost.solver = settings.solver;
  cost.walls = settings.walls;
  cost.threads = settings.threads;
  cost.l0_m = settings.l0_m;
  cost.time_s = solver->time_s();
  cost.steps = static_cast<double>(solver->steps() - warmed_up);
  cost.fluid = static_cast<double>(solver->fluid_count());
  cost.solid = static_cast<double>(solver->solid_count());
  cost.wall_time_s = elapsed_s(begin) * solver_cost(settings).whole_run_over_first_steps;
  cost.probed = true;
  return cost;
}

std::vector<RunCost> probe_costs(const Campaign& campaign, bool force, const std::vector<RunCost>& known) {
  std::vector<RunCost> probed;
  for (const CampaignRun& run : campaign.runs) {
    const Case& c = campaign.case_of(run);
    const auto kin = [&](const RunCost& cost) { return is_of_kind(cost, run.settings); };
    if (std::any_of(known.begin(), known.end(), kin)) continue;
    if (!force && state_of(campaign, run) == CampaignState::finished) continue;
    if (estimate(campaign, run, {}).remaining_s() < worth_a_probe_s) continue;
    probe_into(probed, c, run.settings);
  }
  return probed;
}

Plan probed_plan(const Case& c, const RunSettings& settings, const std::filesystem::path& directory) {
  Plan plan = plan_near(c, settings, directory);
  if (plan.basis != PlanBasis::constants || plan.wall_time_s < worth_a_probe_s) return plan;
  std::vector<RunCost> probed;
  probe_into(probed, c, settings);
  reckon_by(probed, c, settings, plan);
  return plan;
}

}  // namespace sluice
