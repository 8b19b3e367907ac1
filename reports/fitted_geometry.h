// The geometry that a run computed: the case's, with every length fitted to the particle lattice.
#pragma once

#include <string>

#include "reports/studies.h"

namespace sluice {

/// Fluid and bodies whose fitted sides differ between runs of a series by more than a hundredth, so that their values
/// differ for that reason as well: "fluid[0] is 0.57, 0.54, 0.54 m high". Empty where none does, and of runs that do
/// not say what they fitted.
std::string differing_geometry(const ReportData& data, const ResolutionSeries& series);

}  // namespace sluice
