// The outcome of a check in words: what, since which commit, by how much, and where the runs are.
#pragma once

#include <string>
#include <vector>

#include "ci/findings.h"

namespace sluice::ci {

struct Count {
  std::size_t series = 0;
  std::size_t open = 0;
  std::size_t accepted = 0;
  std::size_t fixed = 0;
  std::size_t better = 0;
  std::size_t stale = 0;
};
Count count(const std::vector<SeriesFindings>& all);

/// Plain text. `everything`: also what is accepted, fixed, better, moved or of a metric without alarm.
std::string summary(const std::vector<SeriesFindings>& all, bool everything = false);

/// By how much, what was needed, and who has accepted it: "-5.20 points; -1.00 points needed, 8.1 times the scatter".
std::string detail_text(const SeriesFindings& found, const Finding& finding);

/// One line of a finding, as in the summary: "WORSE  impulse_deviation of P1 nearest: -4.60 % to -9.80 % (...)".
std::string finding_text(const SeriesFindings& found, const Finding& finding);

}  // namespace sluice::ci
