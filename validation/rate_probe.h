// How fast this machine is at what it has not computed yet, told by a solver's first steps.
#pragma once

#include <vector>

#include "validation/campaign.h"
#include "validation/run_cost.h"

namespace sluice {

/// What a run costs by a second of its first steps, at the coarsest particle distance among the case's tiers and its
/// own. Its steps are timed, not counted: reckon_by() takes the rate from it and leaves the time step to the plan.
/// Throws std::invalid_argument when the geometry cannot be built.
RunCost probe_cost(const Case& c, const RunSettings& settings);

/// Probes, one a case, solver and walls, of the runs that are to be computed, take a minute or more by this program's
/// constants, and are of a kind (solver, walls, threads) that is not among the known. One whose
/// first steps fail has none.
std::vector<RunCost> probe_costs(const Campaign& campaign, bool force, const std::vector<RunCost>& known);

}  // namespace sluice
