// The paper's statements on the artificial viscosity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/conclusions.h"
#include "reports/studies.h"
#include "reports/text.h"

namespace sluice::conclusions {

namespace {

std::vector<AlphaSeries> alpha_series(const ReportData& data, const WallsScope& scope) {
  std::vector<AlphaSeries> series = sluice::alpha_series(data);
  std::erase_if(series, [&](const AlphaSeries& one) { return !scope.has(*one.runs.front()); });
  return series;
}

/// Errors at alphas up to a limit and above it.
struct AlphaSides {
  double limit = 0;
  std::vector<double> small{};
  std::vector<double> large{};
  std::string words{};  ///< "28.7 % at 0.001, 37.1 % at 0.1"

  void put(double alpha, std::optional<double> error) {
    if (!error) return;
    (alpha <= limit * (1 + 1e-9) ? small : large).push_back(*error);
    words += fmt::format("{}{} at {}", words.empty() ? "" : ", ", percent(*error), shortest(alpha));
  }
  bool both() const { return !small.empty() && !large.empty(); }
  /// Means would hang on which alphas are there: every error at a small one has to be the smaller. A claim of one side
  /// against the other is refuted by a whole side too: one good run among the large alphas is not enough.
  Verdict smaller_below() const {
    const auto [least_small, most_small] = std::minmax_element(small.begin(), small.end());
    const auto [least_large, most_large] = std::minmax_element(large.begin(), large.end());
    if (smaller(*most_small, *least_large) == Verdict::agrees) return Verdict::agrees;
    return smaller(*most_large, *least_small) == Verdict::agrees ? Verdict::does_not_agree : Verdict::not_told;
  }
};

/// Whether every series errs less at alphas up to the limit.
template <class Error>
Evidence judge_sides(const ReportData& data, const WallsScope& scope, double limit, Error error) {
  Evidence ours{"", Verdict::agrees};
  for (const AlphaSeries& series : alpha_series(data, scope)) {
    AlphaSides sides{limit};
    for (const AnalysedRun* run : series.runs) sides.put(*run->record.alpha(), error(*run));
    if (!sides.both()) continue;
    ours.words += fmt::format("{}{}: {}", ours.words.empty() ? "" : "; ", series.title, sides.words);
    ours.verdict = all_of(ours.verdict, sides.smaller_below());
  }
  return ours;
}

bool is_alpha(double alpha, double stated) {
  return std::abs(alpha / stated - 1) < 1e-9;
}

/// One quantity of a force in each series of runs that differ in alpha alone: "WCSPH ...: 1.2 N at 0.1, 1.5 N at 0.01".
struct AlphaTrend {
  std::string words;
  std::vector<std::vector<std::pair<double, double>>> series;  ///< alpha and value, smallest alpha first
};

/// `needed`: series without a value at this alpha say nothing and are left out.
template <class Measure>
AlphaTrend alpha_trend(const ReportData& data, const WallsScope& scope, const std::string& sensor,
                       const std::string& unit, Measure measure, std::optional<double> needed = std::nullopt) {
  AlphaTrend trend;
  for (const AlphaSeries& runs : alpha_series(data, scope)) {
    std::vector<std::pair<double, double>> points;
    std::string words;
    for (const AnalysedRun* run : runs.runs) {
      const SensorReading* reading = run->primary(sensor);
      const std::optional<double> value = reading == nullptr ? std::nullopt : measure(reading->comparison);
      if (!value) continue;
      points.emplace_back(*run->record.alpha(), *value);
      words += fmt::format("{}{} {} at {}", words.empty() ? "" : ", ", significant(*value, 3), unit,
                           shortest(points.back().first));
    }
    const bool has_needed = !needed || std::any_of(points.begin(), points.end(),
                                                   [&](const auto& point) { return is_alpha(point.first, *needed); });
    if (points.size() < 2 || !has_needed) continue;
    trend.words += fmt::format("{}{}: {}", trend.words.empty() ? "" : "; ", runs.title, words);
    trend.series.push_back(std::move(points));
  }
  return trend;
}

Evidence judge_best_force(const ReportData& data, const WallsScope& scope, const std::string& sensor) {
  constexpr double stated = 0.1;
  const AlphaTrend trend = alpha_trend(
      data, scope, sensor, "%", [](const Comparison& c) { return scaled(c.rmse_over_range, 100); }, stated);
  Evidence ours{trend.words.empty() ? "" : "RMSE / range " + trend.words,
                data.measured_series(sensor) == nullptr ? Verdict::no_measurement : Verdict::agrees};
  for (const auto& points : trend.series) {
    double at_stated = HUGE_VAL;
    double elsewhere = HUGE_VAL;
    for (const auto& [alpha, error] : points) {
      double& least_error = is_alpha(alpha, stated) ? at_stated : elsewhere;
      least_error = std::min(least_error, error);
    }
    ours.verdict = all_of(ours.verdict, smaller(at_stated, elsewhere));
  }
  return ours;
}

/// One point an alpha: of several runs at one, the mean.
std::vector<std::pair<double, double>> means(const std::vector<std::pair<double, double>>& points) {
  std::vector<std::pair<double, double>> out;
  for (std::size_t k = 0; k < points.size();) {
    double sum = 0;
    std::size_t n = 0;
    for (; k + n < points.size() && is_alpha(points[k + n].first, points[k].first); ++n) sum += points[k + n].second;
    out.emplace_back(points[k].first, sum / static_cast<double>(n));
    k += n;
  }
  return out;
}

Evidence judge_oscillations(const ReportData& data, const WallsScope& scope, const std::string& sensor) {
  const AlphaTrend trend = alpha_trend(data, scope, sensor, "N", [](const Comparison& c) { return c.noise.simulated; });
  Evidence ours{trend.words.empty() ? "" : "noise " + trend.words, Verdict::agrees};
  for (const auto& series : trend.series) {
    const auto points = means(series);
    Verdict grows = points.size() < 2 ? Verdict::not_told : smaller(points.back().second, points.front().second);
    for (std::size_t k = 1; k < points.size(); ++k)
      if (smaller(points[k - 1].second, points[k].second) == Verdict::agrees) grows = Verdict::does_not_agree;
    ours.verdict = all_of(ours.verdict, grows);
  }
  return ours;
}

}  // namespace

void add_alpha(Table& table, const ReportData& data) {
  constexpr double limit = 0.001;
  AlphaSides printed{limit};
  for (const double alpha : published_alphas(data)) printed.put(alpha, published_mean(data, "wcsph", alpha));
  const auto error = [&](const AnalysedRun& run) { return mean_impulse_error(data, run); };
  for (const WallsScope& scope : alpha_scopes(data))
    add(table, scope.named("α ≤ 0.001 gives better impulses"), printed.both() ? printed.words : "",
        judge_sides(data, scope, limit, error));
}

// "In good agreements, except for" alpha >= 0.1: without a number for good, the errors on both sides are compared.
void add_wave_heights(Table& table, const ReportData& data) {
  constexpr double limit = 0.01;
  const ShownSensors shown = shown_sensors(data, SensorKind::wave_height);
  if (shown.names.empty()) return;
  const bool unmeasured = std::any_of(shown.names.begin(), shown.names.end(), [&](const std::string& sensor) {
    return data.measured_series(sensor) == nullptr;
  });
  const auto error = [&](const AnalysedRun& run) {
    return mean_over(shown.names, run, [](const SensorReading& r) { return r.comparison.rmse_over_range; });
  };
  for (const WallsScope& scope : alpha_scopes(data)) {
    Evidence ours = judge_sides(data, scope, limit, error);
    if (!ours.words.empty()) ours.words = "RMSE / range " + ours.words;
    if (unmeasured) ours.verdict = Verdict::no_measurement;
    add(table, scope.named("α ≤ 0.01 gives better wave heights"), shown.evidence, ours);
  }
  table.notes.push_back(
      "Wave heights: RMSE over the measured range, in the mean over the probes that the paper shows.");
}

void add_force_statements(Table& table, const ReportData& data) {
  const std::vector<WallsScope> scopes = alpha_scopes(data);
  for (const PublishedFigure& figure : data.the_case.published.figures) {
    const CaseSensor* sensor = data.the_case.find_sensor(figure.sensor);
    if (sensor == nullptr || sensor->kind != SensorKind::force) continue;
    const std::string paper = fmt::format("its figure {}; no numbers are printed", figure.number);
    for (const WallsScope& scope : scopes)
      add(table, scope.named("α = 0.1 gives the best force"), paper, judge_best_force(data, scope, figure.sensor));
    for (const WallsScope& scope : scopes)
      add(table, scope.named("Oscillations of the force grow as α falls"), paper,
          judge_oscillations(data, scope, figure.sensor));
  }
}

}  // namespace sluice::conclusions
