#include "validation/acceptance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

namespace sluice {
namespace {

// Particle distances and viscosities are typed by people: equal means equal to the digits that they type.
bool about_equal(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

const AcceptanceMetric& metric_of(std::string_view name) {
  for (const AcceptanceMetric& metric : acceptance_metrics())
    if (metric.name == name) return metric;
  throw std::invalid_argument(fmt::format("unknown acceptance metric `{}`", name));
}

// Over which a row is evaluated: its own window, its sensor's, or the case's.
Window window_of(const Case& c, const AcceptanceRow& row) {
  if (row.window) return {row.window->start_s, row.window->end_s};
  if (const CaseSensor* sensor = c.find_sensor(row.sensor)) return comparison_window(c, *sensor);
  return {c.window.start_s, c.window.end_s};
}

// Comparisons are costly (the lag's search most of all): one a column and window, shared by its rows.
class Comparisons {
 public:
  Comparisons(const Case& c, const RunRecord& run, const Measurements& measured)
      : case_(c), run_(run), measured_(measured) {}

  // nullptr with a reason when there is nothing to compare.
  const Comparison* find(const AcceptanceRow& row, std::string& reason) {
    const CaseSensor* sensor = case_.find_sensor(row.sensor);
    if (sensor == nullptr) throw std::invalid_argument("unknown sensor " + row.sensor);
    const std::string column = probe_column(*sensor, row.model);
    if (!run_.probes.has(column)) {
      reason = "no column " + column;
      return nullptr;
    }
    const MeasuredSeries* measured = measured_.find(row.sensor);
    if (measured == nullptr) {
      reason = "no measurement of " + row.sensor;
      return nullptr;
    }
    const Window window = window_of(case_, row);
    const Key key{column, window.begin_s, window.end_s};
    auto found = done_.find(key);
    if (found == done_.end())
      found =
          done_.emplace(key, compare(run_.probes.column(column), *measured, window, comparison_options(*sensor))).first;
    return &found->second;
  }

 private:
  const Case& case_;
  const RunRecord& run_;
  const Measurements& measured_;
  using Key = std::tuple<std::string, double, double>;
  std::map<Key, Comparison> done_;
};

// A run that stopped early proves nothing, however good its counts look.
std::string why_unfinished(const RunRecord& run, Window window) {
  if (const std::string status = run.status(); !status.empty() && status != "finished") return "the run is " + status;
  const std::vector<double>& times_s = run.probes.times_s();
  const std::string remark = coverage_remark({times_s, times_s}, window);
  return remark.empty() ? "" : "the run " + remark;
}

AcceptanceCheck check_row(const Case& c, const AcceptanceRow& row, const RunRecord& run, Comparisons& comparisons) {
  AcceptanceCheck check{row, AcceptanceVerdict::not_applicable, std::nullopt, ""};
  if (!applies(row, run)) return check;
  check.verdict = AcceptanceVerdict::missing;
  check.reason = why_unfinished(run, window_of(c, row));
  if (!check.reason.empty()) return check;
  if (metric_of(row.metric).needs_sensor) {
    if (const Comparison* comparison = comparisons.find(row, check.reason)) {
      check.value = sensor_metric(row.metric, *comparison);
      if (!check.value) check.reason = comparison->remarks.empty() ? "no such value" : comparison->remarks.front();
    }
  } else {
    check.value = run_metric(row.metric, run);
    if (!check.value) check.reason = "run.json does not tell";
  }
  if (!check.value) return check;
  const bool inside = *check.value >= row.lower && *check.value <= row.upper;
  check.verdict = inside ? AcceptanceVerdict::pass : AcceptanceVerdict::fail;
  return check;
}

}  // namespace

std::string_view to_string(AcceptanceVerdict verdict) {
  switch (verdict) {
    case AcceptanceVerdict::pass:
      return "pass";
    case AcceptanceVerdict::fail:
      return "FAIL";
    case AcceptanceVerdict::missing:
      return "missing";
    case AcceptanceVerdict::not_applicable:
      break;
  }
  return "not applicable";
}

bool applies(const AcceptanceRow& row, const RunRecord& run) {
  if (row.solver != run.solver) return false;
  if (!row.walls.empty() && row.walls != run.walls) return false;
  if (run.l0_m < row.l0_min_m && !about_equal(run.l0_m, row.l0_min_m)) return false;
  if (run.l0_m > row.l0_max_m && !about_equal(run.l0_m, row.l0_max_m)) return false;
  return !row.alpha || (run.alpha() && about_equal(*run.alpha(), *row.alpha));
}

std::optional<double> sensor_metric(std::string_view metric, const Comparison& c) {
  if (metric == "impulse_deviation") return c.impulse.deviation();
  if (metric == "arrival_difference_s") return c.arrival_s.difference();
  if (metric == "half_peak_time_difference_s") return c.half_peak_s.difference();
  if (metric == "peak_deviation") return c.peak.deviation();
  if (metric == "smoothed_peak_deviation") return c.smoothed_peak.deviation();
  if (metric == "peak_time_difference_s") return c.peak_time_s.difference();
  if (metric == "rmse_over_range") return c.rmse_over_range;
  if (metric == "lag_s") return c.lag_s;
  if (metric == "share_inside_band") return c.share_inside_band;
  throw std::invalid_argument(fmt::format("`{}` is not a metric of a sensor", metric));
}

std::optional<double> run_metric(std::string_view metric, const RunRecord& run) {
  if (metric == "lost_through_walls") return run.number("lost.through_walls");
  if (metric == "number_density_max_over_n0") return run.number("facts.number_density_max_over_n0");
  if (metric == "fluid_volume_deviation") return run.number("fluid_volume.deviation");
  if (metric != "lost_over_top_share")
    throw std::invalid_argument(fmt::format("`{}` is not a metric of a whole run", metric));
  const auto lost = run.number("lost.over_top");
  const auto all = run.number("particles.fluid");
  if (!lost || !all || *all <= 0) return std::nullopt;
  return *lost / *all;
}

std::vector<AcceptanceCheck> check_acceptance(const Case& c, const RunRecord& run, const Measurements& measured) {
  Comparisons comparisons(c, run, measured);
  std::vector<AcceptanceCheck> checks;
  for (const AcceptanceRow& row : c.acceptance) checks.push_back(check_row(c, row, run, comparisons));
  return checks;
}

bool all_passed(const std::vector<AcceptanceCheck>& checks) {
  bool any = false;
  for (const AcceptanceCheck& check : checks) {
    if (check.verdict == AcceptanceVerdict::not_applicable) continue;
    if (check.verdict != AcceptanceVerdict::pass) return false;
    any = true;
  }
  return any;
}

std::string verdict_text(const std::vector<AcceptanceCheck>& checks) {
  if (all_passed(checks)) return "all bands hold";
  const bool missed = std::any_of(checks.begin(), checks.end(), [](const AcceptanceCheck& check) {
    return check.verdict == AcceptanceVerdict::fail;
  });
  return missed ? "A BAND IS MISSED" : "A BAND COULD NOT BE JUDGED";
}

std::string window_text(const TimeWindow& window) {
  return fmt::format("{:g} .. {:g} s", window.start_s, window.end_s);
}

std::string acceptance_name(const AcceptanceRow& row) {
  std::string name = row.metric;
  if (!row.sensor.empty()) name += " " + row.sensor;
  if (!row.model.empty()) name += " " + row.model;
  if (row.window) name += fmt::format(" {}", window_text(*row.window));
  return name;
}

std::string acceptance_value_text(const AcceptanceRow& row, double value) {
  const std::string_view unit = metric_of(row.metric).unit;
  if (unit == "1") return fmt::format("{:+.1f} %", 100 * value);
  if (unit == "s") return fmt::format("{:+.0f} ms", 1000 * value);
  if (unit == "n0") return fmt::format("{:.2f} n0", value);
  return fmt::format("{:.0f}", value);
}

std::string acceptance_band_text(const AcceptanceRow& row) {
  const bool low = std::isfinite(row.lower), high = std::isfinite(row.upper);
  if (low && high)
    return fmt::format("{} to {}", acceptance_value_text(row, row.lower), acceptance_value_text(row, row.upper));
  if (high) return "at most " + acceptance_value_text(row, row.upper);
  return "at least " + acceptance_value_text(row, row.lower);
}

std::string acceptance_table(const std::vector<AcceptanceCheck>& checks) {
  std::string text = fmt::format("{:<36} {:>10}   {:<24} {}\n", "quantity", "value", "band", "verdict");
  for (const AcceptanceCheck& check : checks) {
    if (check.verdict == AcceptanceVerdict::not_applicable) continue;
    const std::string value = check.value ? acceptance_value_text(check.row, *check.value) : "-";
    text += fmt::format("{:<36} {:>10}   {:<24} {}", acceptance_name(check.row), value, acceptance_band_text(check.row),
                        to_string(check.verdict));
    text += check.reason.empty() ? "\n" : " (" + check.reason + ")\n";
  }
  return text;
}

}  // namespace sluice
