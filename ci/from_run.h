// Results for the ledger from a run directory: accuracy as reports and acceptance rows have it, and cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ci/ledger.h"

namespace sluice::ci {

/// What the caller knows better than the file, or what the file does not say. Empty: as the file says.
struct Provenance {
  std::string commit{};
  std::string date{};
  std::string machine{};
  std::string compiler{};
  std::string flags{};
  std::string link{};  ///< of the run itself; empty: the path as given
};

/// All results of one run. Of a run that did not finish only `finished` = 0: its other values compare with nothing.
/// What the run should have given and did not (the acceptance rows that speak of it, the primary readings of measured
/// sensors) is a result without a value, with the reason. Throws std::runtime_error: no run directory, unknown case, a
/// run that is still going on, one whose parts were computed by different builds or machines, or one that does not say
/// its commit, date or machine when `given` does not either.
std::vector<Result> results_of_run(const std::filesystem::path& directory, const Provenance& given = {});

}  // namespace sluice::ci
