// What the ledger's metrics mean: which way is better, on what a value depends, and the smallest change worth a look.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "ci/shifts.h"

namespace sluice::ci {

enum class Family { accuracy, cost };

/// `nearest_zero`: a signed deviation. `unchanged`: neither way is better, and every shift is to be explained.
/// `unknown`: shown, never judged.
enum class Better { smaller, larger, nearest_zero, unchanged, unknown };

struct MetricKind {
  std::string_view name;
  Family family = Family::cost;
  Better better = Better::unknown;
  bool same_machine = false;  ///< values of different machines or numbers of threads are different series
  bool alarms = false;        ///< whether a turn for the worse fails `ledger check`; others are shown only
  Tolerance tolerance;
  std::string_view meaning;
};

/// Every metric that is known, in the order in which people read them.
const std::vector<MetricKind>& metric_kinds();

/// The kind of a metric. Names that are not known (counters of a benchmark) are costs of unknown direction, tied to the
/// machine, that raise no alarm.
const MetricKind& kind_of(std::string_view metric);

/// Its place in metric_kinds(); behind all of them when it is not known.
std::size_t order_of(std::string_view metric);

/// How bad a level is: grows as the metric gets worse. Zero for metrics of unknown direction.
double badness(Better better, double level);

std::string_view to_string(Family family);
std::string_view to_string(Better better);

}  // namespace sluice::ci
