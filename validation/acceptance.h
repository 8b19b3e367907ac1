// Acceptance rows of a case, evaluated on one run: the one implementation that `sluice validate`, the reports and the
// validation test share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.h"
#include "validation/measurements.h"
#include "validation/metrics.h"
#include "validation/run_directory.h"

namespace sluice {

/// `missing`: the row applies, but the run or the measurement lacks what it needs. Counts as not passed.
enum class AcceptanceVerdict { pass, fail, missing, not_applicable };

std::string_view to_string(AcceptanceVerdict verdict);

/// One row on one run.
struct AcceptanceCheck {
  AcceptanceRow row;
  AcceptanceVerdict verdict = AcceptanceVerdict::not_applicable;
  std::optional<double> value;  ///< in the metric's unit
  std::string reason;           ///< of `missing`
};

/// Whether a row speaks of this run: solver, wall model, particle distance and alpha.
bool applies(const AcceptanceRow& row, const RunRecord& run);

/// A sensor metric's value; nullopt when the comparison lacks it. Throws std::invalid_argument for an unknown metric.
std::optional<double> sensor_metric(std::string_view metric, const Comparison& comparison);

/// A whole-run metric's value; nullopt when the manifest lacks it. Throws std::invalid_argument for an unknown metric.
std::optional<double> run_metric(std::string_view metric, const RunRecord& run);

/// Every row of the case, in its order. Rows of sensors that `measured` has no series for are missing. Bounds are
/// inclusive.
std::vector<AcceptanceCheck> check_acceptance(const Case& c, const RunRecord& run, const Measurements& measured);

/// True when at least one row applies and every applicable row passes.
bool all_passed(const std::vector<AcceptanceCheck>& checks);

/// "all bands hold", or what is amiss.
std::string verdict_text(const std::vector<AcceptanceCheck>& checks);

/// "impulse_deviation P1 wall" or "impulse_deviation F 0.3 .. 1.3 s", and a value or bound for people ("+4.0 %", "+15
/// ms", "3").
std::string acceptance_name(const AcceptanceRow& row);
/// "0.3 .. 1.3 s".
std::string window_text(const TimeWindow& window);
std::string acceptance_value_text(const AcceptanceRow& row, double value);
std::string acceptance_band_text(const AcceptanceRow& row);

/// A plain-text table of the applicable rows, for terminals and logs.
std::string acceptance_table(const std::vector<AcceptanceCheck>& checks);

}  // namespace sluice
