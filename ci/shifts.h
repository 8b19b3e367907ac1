// Lasting shifts in the level of a series of nightly values.
//
// E-divisive (e_divisive.h) names the places. By itself it raises far too many alarms when it is asked every night, so
// that a shift must also be large against the history's own scatter, confirmed, and worth a person's time:
//   - the new level, over n_after nights, differs from the old one, over n_before nights, by at least
//       scatter * max(least_scatters, critical * sqrt(1/n_before + 1/(n_after - 1/2))),
//     the half because a handful of nights may all be wild ones (and twice that in a series of less than a month);
//   - at least `nights_to_confirm` nights, and three quarters of all since, lie beyond the middle between the levels;
//   - the difference is at least the metric's own tolerance.
// A level is a trimmed mean. The scatter is that of the values about their own level, old and new, and of earlier
// segments of the series: root mean square, with values beyond three (scaled) median absolute deviations drawn in.
// sequential_proof_test.cpp shows what these figures give: false alarms in a year, and how soon a step is found.
//
// A repeatable series (accuracy, counts) that has been quiet, all values within half of the tolerance, needs no
// statistics: the first value beyond the tolerance is a shift.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ci/e_divisive.h"

namespace sluice::ci {

/// The smallest shift that is worth a person's time.
struct Tolerance {
  double absolute = 0;  ///< in the series' unit
  double relative = 0;  ///< share of the old level; the larger of both counts
  bool repeatable = false;

  double at(double level) const;
};

struct ShiftRule {
  std::size_t window = 90;  ///< latest values looked at, at most
  std::size_t nights_to_confirm = 3;
  std::size_t least_before = 8;      ///< values before a shift ...
  std::size_t least_residuals = 12;  ///< ... and values that the scatter is taken from, earlier segments included
  std::size_t many_residuals = 30;   ///< with fewer the scatter is little more than a guess: twice as much is asked for
  double critical = 6.5;
  double least_scatters = 2.1;
  double share_beyond_middle = 0.75;
  std::size_t quiet_values = 5;  ///< of a repeatable series, before its first value can be told to differ
  EDivisiveOptions division;
};

/// Indices count values of the series.
struct Shift {
  std::size_t first = 0;          ///< first value at the new level
  std::size_t found = 0;          ///< value with which it was found: with values up to and including this one
  double before = 0;              ///< level before, of the values in the window
  double after = 0;               ///< level since, when found
  double scatter = 0;             ///< standard deviation of a single value about its level
  double threshold = 0;           ///< what |after - before| had to reach
  std::optional<double> p_value;  ///< of E-divisive; none where a quiet series needed no test
};

/// Replays the series night by night: what stands at night k follows from the values up to k alone. After a shift the
/// history begins anew with the new level. Values must be finite.
std::vector<Shift> find_shifts(std::span<const double> values, const Tolerance& tolerance, const ShiftRule& rule = {});

/// Robust standard deviation of residuals (about zero): see above. Zero when there are none.
double scatter_of(std::span<const double> residuals);

double median(std::span<const double> values);

/// Mean of what is left when a sixth of the values (rounded down) is taken away at each end.
double trimmed_mean(std::span<const double> values);

}  // namespace sluice::ci
