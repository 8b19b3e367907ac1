#include "ci/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sluice::ci {
namespace {

/// The metric's tolerance, widened by what people have called scatter.
Tolerance tolerance_of(const MetricSeries& series, const std::string& id, const Ledger& ledger) {
  Tolerance tolerance = series.kind().tolerance;
  double squares = 0;
  int count = 0;
  for (const Acceptance& acceptance : ledger.acceptances) {
    if (!acceptance.scatter || acceptance.series != id) continue;
    squares += acceptance.difference * acceptance.difference;
    ++count;
  }
  if (count > 0) tolerance.absolute = std::max(tolerance.absolute, scatter_factor * std::sqrt(squares / count));
  return tolerance;
}

Verdict verdict_of(Better better, const Shift& shift) {
  const double change = badness(better, shift.after) - badness(better, shift.before);
  if (change > shift.threshold / 2) return Verdict::worse;
  if (change < -shift.threshold / 2) return Verdict::better;
  return Verdict::moved;
}

/// Gives every acceptance of the series to the finding nearest to it: one that later nights have placed anew is still
/// the one that was accepted, and another close by is not.
void match_acceptances(SeriesFindings& found, const std::string& id, const Ledger& ledger) {
  const auto position = [&](const std::string& date) {
    return std::count_if(found.series.points.begin(), found.series.points.end(),
                         [&](const Result* point) { return point->date < date; });
  };
  for (const Acceptance& acceptance : ledger.acceptances) {
    if (acceptance.series != id) continue;
    Finding* nearest = nullptr;
    std::ptrdiff_t least = acceptance_reach + 1;
    for (Finding& finding : found.findings) {
      const auto distance = std::abs(position(finding.first->date) - position(acceptance.first_date));
      if (distance >= least) continue;
      least = distance;
      nearest = &finding;
    }
    if (nearest != nullptr) nearest->acceptance = &acceptance;
  }
}

/// Whether a level is that from before the finding, or better.
bool has_come_back(const Finding& finding, Better better, double level) {
  if (better == Better::unchanged) return std::abs(level - finding.shift.before) < finding.shift.threshold / 2;
  return badness(better, level) < badness(better, finding.shift.before) + finding.shift.threshold / 2;
}

/// `levels`: those that the series has had since, the finding's own first.
State state_of(const Finding& finding, const MetricKind& kind, std::span<const double> levels) {
  const bool harmless = finding.verdict == Verdict::moved && kind.better != Better::unchanged;
  if (!kind.alarms || finding.verdict == Verdict::better || harmless) return State::note;
  if (finding.acceptance != nullptr) return State::accepted;
  if (finding.verdict == Verdict::missing) return State::open;
  const bool fixed = std::any_of(levels.begin(), levels.end(),
                                 [&](double level) { return has_come_back(finding, kind.better, level); });
  return fixed ? State::fixed : State::open;
}

void add_shifts(SeriesFindings& found, const Tolerance& tolerance, const ShiftRule& rule) {
  for (const Shift& shift : find_shifts(found.values, tolerance, rule)) {
    Finding finding;
    finding.shift = shift;
    finding.verdict = verdict_of(found.series.kind().better, shift);
    finding.last_before = found.valued[shift.first - 1];
    finding.first = found.valued[shift.first];
    found.findings.push_back(finding);
  }
}

/// The level that each shift led to: the median of the values up to the next one.
std::vector<double> levels_of(const SeriesFindings& found) {
  std::vector<double> levels;
  for (std::size_t k = 0; k < found.findings.size(); ++k) {
    const std::size_t first = found.findings[k].shift.first;
    const std::size_t end = k + 1 < found.findings.size() ? found.findings[k + 1].shift.first : found.values.size();
    levels.push_back(median(std::span(found.values).subspan(first, end - first)));
  }
  return levels;
}

/// The last points have no value, and earlier ones have.
void add_missing(SeriesFindings& found) {
  const auto& points = found.series.points;
  std::size_t first = points.size();
  while (first > 0 && !points[first - 1]->value) --first;
  if (first == 0 || first == points.size()) return;
  Finding finding;
  finding.verdict = Verdict::missing;
  finding.shift.first = finding.shift.found = found.values.size();
  finding.shift.before = *points[first - 1]->value;
  finding.last_before = points[first - 1];
  finding.first = points[first];
  found.findings.push_back(finding);
}

bool is_percentage(const MetricSeries& series) {
  return series.kind().family == Family::accuracy && series.unit == "1" && series.key.metric != "finished" &&
         series.kind().better != Better::unchanged;
}

bool is_time_difference(const MetricSeries& series) {
  return series.kind().family == Family::accuracy && series.unit == "s";
}

}  // namespace

std::vector<SeriesFindings> find_all(const Ledger& ledger, const ShiftRule& rule) {
  std::string newest;
  for (const Result& result : ledger.results) newest = std::max(newest, result.date);
  std::vector<SeriesFindings> all;
  for (MetricSeries& series : series_of(ledger)) {
    SeriesFindings& found = all.emplace_back();
    found.series = std::move(series);
    for (const Result* point : found.series.points) {
      if (!point->value) continue;
      found.valued.push_back(point);
      found.values.push_back(*point->value);
    }
    const std::string id = found.series.key.id();
    add_shifts(found, tolerance_of(found.series, id, ledger), rule);
    const std::vector<double> levels = levels_of(found);
    add_missing(found);
    match_acceptances(found, id, ledger);
    for (std::size_t k = 0; k < found.findings.size(); ++k)
      found.findings[k].state =
          state_of(found.findings[k], found.series.kind(), std::span(levels).subspan(std::min(k, levels.size())));
    found.stale = days_of(newest) - days_of(found.series.points.back()->date) > stale_days;
  }
  return all;
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::worse:
      return "worse";
    case Verdict::better:
      return "better";
    case Verdict::missing:
      return "missing";
    case Verdict::moved:
      break;
  }
  return "moved";
}

std::string_view to_string(State state) {
  switch (state) {
    case State::open:
      return "open";
    case State::accepted:
      return "accepted";
    case State::fixed:
      return "fixed";
    case State::note:
      break;
  }
  return "note";
}

std::string value_text(const MetricSeries& series, double value) {
  if (is_percentage(series))
    return series.kind().better == Better::nearest_zero ? fmt::format("{:+.2f} %", 100 * value)
                                                        : fmt::format("{:.2f} %", 100 * value);
  if (is_time_difference(series)) return fmt::format("{:+.1f} ms", 1000 * value);
  return series.unit == "1" ? fmt::format("{:.5g}", value) : fmt::format("{:.5g} {}", value, series.unit);
}

std::string change_text(const MetricSeries& series, double before, double after) {
  if (is_percentage(series)) return fmt::format("{:+.2f} points", 100 * (after - before));
  if (is_time_difference(series)) return fmt::format("{:+.1f} ms", 1000 * (after - before));
  if (before == 0) return fmt::format("{:+.5g}", after - before);
  return fmt::format("{:+.2f} %", 100 * (after - before) / std::abs(before));
}

}  // namespace sluice::ci
