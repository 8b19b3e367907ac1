// What the reader should know of a run before trusting it.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis.h"

namespace sluice {

/// Of a run whose readings are there: how it ended, what part of the window it covers, from which other inputs of the
/// case file it was made, columns that no sensor reads, values that look like those of another unit, particles through
/// walls.
std::vector<std::string> run_problems(const AnalysedRun& run, const ReportData& data);

}  // namespace sluice
