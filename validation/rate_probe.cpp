#include "validation/rate_probe.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>

#include "validation/solver_factory.h"

namespace sluice {
namespace {

constexpr int steps_to_warm_up = 3;
constexpr int fewest_steps = 5;
constexpr double probe_s = 1;
constexpr double worth_a_probe_s = 60;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

RunCost probe_cost(const Case& c, const RunSettings& settings) {
  RunSettings coarse = settings;
  for (const Tier& tier : c.tiers) coarse.l0_m = std::max(coarse.l0_m, tier.l0_m);
  const auto solver = make_solver(c, build_scene(scene_description(c, coarse)), coarse);
  for (int k = 0; k < steps_to_warm_up; ++k) solver->step();
  const std::int64_t warmed_up = solver->steps();
  const auto begin = std::chrono::steady_clock::now();
  while (solver->steps() < warmed_up + fewest_steps || seconds_since(begin) < probe_s) solver->step();
  RunCost cost;
  cost.case_hash = c.hash;
  cost.solver = coarse.solver;
  cost.walls = coarse.walls;
  cost.threads = coarse.threads;
  cost.l0_m = coarse.l0_m;
  cost.time_s = solver->time_s();
  cost.steps = static_cast<double>(solver->steps() - warmed_up);
  cost.fluid = static_cast<double>(solver->fluid_count());
  cost.wall_time_s = seconds_since(begin) * solver_cost(coarse).whole_run_over_first_steps;
  cost.probed = true;
  return cost;
}

std::vector<RunCost> probe_costs(const Campaign& campaign, bool force, const std::vector<RunCost>& known) {
  std::vector<RunCost> probed;
  for (const CampaignRun& run : campaign.runs) {
    const Case& c = campaign.case_of(run);
    const auto kin = [&](const RunCost& cost) { return is_of_kind(cost, run.settings); };
    const auto twin = [&](const RunCost& cost) { return kin(cost) && cost.case_hash == c.hash; };
    if (std::any_of(known.begin(), known.end(), kin) || std::any_of(probed.begin(), probed.end(), twin)) continue;
    if (!force && state_of(campaign, run) == CampaignState::finished) continue;
    if (estimate(campaign, run, {}).remaining_s() < worth_a_probe_s) continue;
    try {
      probed.push_back(probe_cost(c, run.settings));
    } catch (const std::exception&) {
      continue;  // whatever it is, the run itself will tell, and the others go on
    }
  }
  return probed;
}

}  // namespace sluice
