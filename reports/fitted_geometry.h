// The geometry that a run computed: the case's, with every length fitted to the particle lattice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/studies.h"
#include "solvers/scene.h"

namespace sluice {

/// Lengths that a run had to fit; missing where its manifest does not say.
std::optional<std::vector<FittedLength>> fitted_lengths(const RunRecord& run);

/// Fitted sides of fluid and bodies, the water's way to a body and the room behind it, where they differ between runs
/// of a series by more than a hundredth, so that values differ for that reason as well: "fluid[0] is 0.570, 0.540,
/// 0.540 m high; obstacle[0] is 1.20, 1.16, 1.17 m from fluid[0]". Empty where none does, and of runs that do not say
/// what they fitted.
std::string differing_geometry(const ReportData& data, const ResolutionSeries& series);

}  // namespace sluice
