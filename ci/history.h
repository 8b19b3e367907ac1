// The ledger as series: one metric of one kind of run, in the order of the nights.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ci/ledger.h"
#include "ci/metric_kinds.h"

namespace sluice::ci {

/// What makes two results points of one series.
struct SeriesKey {
  std::string case_name;
  std::string solver;
  std::string parameters;  ///< as JSON, keys sorted
  std::string metric;
  std::string of;
  std::string machine;  ///< of metrics that depend on the machine, with the number of threads; empty otherwise

  bool operator<(const SeriesKey& other) const;
  /// Eight hexadecimal digits to name the series by on a command line.
  std::string id() const;
  /// "impulse_deviation of P1 nearest".
  std::string quantity() const;
  /// "kleefsman mps dummies, l0_m 0.02": the kind of run, without the machine.
  std::string run_kind() const;
};
SeriesKey key_of(const Result& result);

struct MetricSeries {
  SeriesKey key;
  std::string unit;
  std::vector<const Result*> points;                  ///< by date, equal dates as in the file; values may be missing
  std::vector<std::shared_ptr<const Result>> absent;  ///< those of the points that no line of the ledger has

  const MetricKind& kind() const { return kind_of(key.metric); }
};

/// All series of a ledger, by key. A run that came to its end without an accuracy that an earlier one of its kind gave
/// is a point without a value. Points refer to the ledger's results: it must outlive them.
std::vector<MetricSeries> series_of(const Ledger& ledger);

}  // namespace sluice::ci
