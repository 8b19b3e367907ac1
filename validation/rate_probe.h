// How fast this machine is at what it has not computed yet, told by a solver's first steps.
#pragma once

#include <filesystem>
#include <vector>

#include "validation/campaign.h"
#include "validation/run_cost.h"

namespace sluice {

/// What a run costs by a second of its first steps. Its steps are timed, not counted: reckon_by() takes the rate from
/// it and leaves the time step to the plan. Throws std::invalid_argument when the geometry cannot be built.
RunCost probe_cost(const Case& c, const RunSettings& settings);

/// Probes of the runs that are to be computed, take twenty seconds or more by this program's constants, and are of a
/// kind (solver, walls, threads) that is not among the known: one for each case, kind, and particle distance, which is
/// the run's own or, where its particles are too many to step through them in seconds, that of the finest tier of its
/// case where they are not. One without such a tier, or whose first steps fail, has none.
std::vector<RunCost> probe_costs(const Campaign& campaign, bool force, const std::vector<RunCost>& known);

/// plan_near() or, where no run near is of its kind and it takes twenty seconds or more, by a probe.
Plan probed_plan(const Case& c, const RunSettings& settings, const std::filesystem::path& directory);

}  // namespace sluice
