// What the ledger's series have done: shifts for the worse and for the better, values that no longer come, and which of
// them people know of.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ci/history.h"
#include "ci/ledger.h"
#include "ci/shifts.h"

namespace sluice::ci {

enum class Verdict {
  worse,
  better,
  moved,    ///< to another value that is neither, such as -4 % to +4 %; an alarm where values are to stay unchanged
  missing,  ///< the last runs gave no value where earlier ones did
};

enum class State {
  open,      ///< worse or missing, and nobody has accepted it: `ledger check` fails
  accepted,  ///< on record with a reason
  fixed,     ///< worse, but the level has come back since, whatever it did later
  note,      ///< better, moved, or of a metric that raises no alarm
};

struct Finding {
  Shift shift;  ///< indices count the values of SeriesFindings; of `missing` only `before`, `first` and `found` are set
  Verdict verdict = Verdict::moved;
  State state = State::note;
  const Result* last_before = nullptr;     ///< last result at the old level
  const Result* first = nullptr;           ///< first result at the new one
  const Acceptance* acceptance = nullptr;  ///< of `accepted`
};

/// A series with its findings, in the order of the nights.
struct SeriesFindings {
  MetricSeries series;
  std::vector<const Result*> valued;  ///< the points that have a value
  std::vector<double> values;         ///< theirs
  std::vector<Finding> findings;
  bool stale = false;  ///< no point in the last `stale_days` of the ledger
};

inline constexpr double stale_days = 7;
/// An acceptance holds for a shift that begins within this many points of the accepted one: later nights may place it
/// anew.
inline constexpr std::size_t acceptance_reach = 3;
/// A later shift must exceed those accepted as scatter by this factor over their root mean square.
inline constexpr double scatter_factor = 3;

/// All series of the ledger, by key. Refers to the ledger, which must outlive the answer; a finding refers to its
/// series.
std::vector<SeriesFindings> find_all(const Ledger& ledger, const ShiftRule& rule = {});

std::string_view to_string(Verdict verdict);
std::string_view to_string(State state);

/// "-4.6 %", "+15 ms", "5.6e+06 1/s": a value as people read it.
std::string value_text(const MetricSeries& series, double value);
/// "+5.2 points", "-10.7 %": what has changed, in points of per cent for deviations and relative for costs.
std::string change_text(const MetricSeries& series, double before, double after);

}  // namespace sluice::ci
