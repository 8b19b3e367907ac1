// What runs have cost on this machine, as their manifests tell it, and what another one will cost by that.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/case.h"
#include "validation/plan.h"
#include "validation/run_settings.h"

namespace sluice {

/// A finished run on this machine.
struct RunCost {
  std::string case_hash;
  std::string computed_hash;  ///< empty where its manifest does not tell it yet
  std::string solver;
  std::string walls;
  std::string parameters;  ///< all but alpha, as JSON
  double alpha = 0;        ///< zero where there is none
  int threads = 0;
  double l0_m = 0;
  double time_s = 0;  ///< simulated
  double steps = 0;
  double fluid = 0;  ///< particles
  double solid = 0;  ///< likewise
  double wall_time_s = 0;
  bool probed = false;  ///< no run, but a second of its first steps (rate_probe.h)
};

/// Whether it has a run's solver, walls and number of threads: what a rate hangs on most.
bool is_of_kind(const RunCost& cost, const RunSettings& settings);

/// Of the finished runs of this machine in these directories. What is no run, cannot be read, or was not computed here
/// is passed over.
std::vector<RunCost> run_costs(const std::vector<std::filesystem::path>& directories);

/// Directories with a manifest beside `directory` and one level below its neighbours, in the order of their names; at
/// most 1000. `directory` need not exist.
std::vector<std::filesystem::path> runs_near(const std::filesystem::path& directory);

/// Reckons a plan's time by the particle-steps a second (of fluid, and of solid by its share: SolverCost) of the
/// nearest of `costs` in particle distance, alpha and whether other parameters are the same, among those of the same
/// solver, walls and number of threads, one of the same case before a probe, and a probe before one of another case.
/// Where that was the same flow (case and parameters, alpha aside), its time step counts too: steps a second of flow go
/// with 1 / l0, and hang a little on alpha. Without such a run the plan stays as it is.
void reckon_by(const std::vector<RunCost>& costs, const Case& c, const RunSettings& settings, Plan& plan);

/// plan_run(), its time reckoned by the runs near the directory that the run will go to.
Plan plan_near(const Case& c, const RunSettings& settings, const std::filesystem::path& directory);

}  // namespace sluice
