// The paper's statements on how well the two methods predict pressures.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "reports/conclusions.h"
#include "reports/studies.h"
#include "reports/text.h"

namespace sluice::conclusions {

namespace {

std::string printed_accuracy(const ReportData& data) {
  std::vector<double> wcsph;
  for (const double alpha : published_alphas(data))
    if (const auto error = published_mean(data, "wcsph", alpha)) wcsph.push_back(*error);
  const auto mps = published_mean(data, "mps", std::nullopt);
  if (!mps || wcsph.empty()) return "";
  return fmt::format("MPS {}, WCSPH {} to {}", percent(*mps), percent(*std::min_element(wcsph.begin(), wcsph.end())),
                     percent(*std::max_element(wcsph.begin(), wcsph.end())));
}

/// How many impulses are too low.
struct LowImpulses {
  int low = 0;
  int all = 0;
  void put(std::optional<double> deviation) {
    low += deviation && *deviation < 0;
    all += deviation.has_value();
  }
  std::string words() const { return all > 0 ? fmt::format("{} of {} impulses too low", low, all) : ""; }
};

LowImpulses our_low_impulses(const ReportData& data, const WallsScope& scope) {
  LowImpulses ours;
  for (const AnalysedRun* run : judged_runs(data, "wcsph", scope)) {
    for (const std::string& sensor : data.headline_sensors()) {
      const SensorReading* reading = run->primary(sensor);
      ours.put(reading == nullptr ? std::nullopt : reading->comparison.impulse.deviation());
    }
  }
  return ours;
}

/// The smallest value of each method, and whose it is.
struct LeastOfBoth {
  double mps = 0;
  double wcsph = 0;
  const AnalysedRun& mps_run;
  const AnalysedRun& wcsph_run;
};

/// Whether MPS has the smaller one; nothing to say where a method has none.
template <class Measure, class Words>
Evidence judge_least(const ReportData& data, const WallsScope& scope, Measure measure, Words words) {
  const BothMethods both = finest_of_both(data, scope);
  const auto [mps, mps_run] = least(both.mps, measure);
  const auto [wcsph, wcsph_run] = least(both.wcsph, measure);
  if (!mps || !wcsph) return {};
  return {words(LeastOfBoth{*mps, *wcsph, *mps_run, *wcsph_run}), smaller(*mps, *wcsph)};
}

/// Noise of a pressure from after the impact, whose one spike would hide the rest, to where the paper's text sees
/// oscillations; missing where the wave comes too late for that.
std::optional<double> noise_after_impact(const ReportData& data, const SensorReading& reading) {
  constexpr double impact_s = 0.1;
  constexpr double end_s = 1.5;
  constexpr double least_s = 0.1;
  const Window whole = data.window_of(reading.sensor);
  const auto arrival_s = reading.comparison.arrival_s.measured;
  const Window after{arrival_s ? *arrival_s + impact_s : whole.begin_s, std::min(end_s, whole.end_s)};
  if (after.end_s - after.begin_s < least_s) return std::nullopt;
  return noise(reading.series, after);
}

}  // namespace

void add_accuracy(Table& table, const ReportData& data) {
  const std::string paper = printed_accuracy(data);
  const auto error = [&](const AnalysedRun& run) { return mean_impulse_error(data, run); };
  for (const WallsScope& scope : walls_scopes(data)) {
    const Evidence ours = judge_least(data, scope, error, [](const LeastOfBoth& l) {
      return fmt::format("MPS {} ({}), best WCSPH {} ({})", percent(l.mps), l.mps_run.key, percent(l.wcsph),
                         l.wcsph_run.label);
    });
    add(table, scope.named("MPS is more accurate in impulse"), paper, ours);
  }
}

void add_sign(Table& table, const ReportData& data) {
  LowImpulses printed;
  for (const double alpha : published_alphas(data))
    for (const std::string& sensor : data.headline_sensors())
      printed.put(published_deviation(data, sensor, "wcsph", alpha));
  for (const WallsScope& scope : walls_scopes(data)) {
    const LowImpulses ours = our_low_impulses(data, scope);
    add(table, scope.named("WCSPH underestimates the impulses"), printed.words(),
        {ours.words(), ours.low == ours.all ? Verdict::agrees : Verdict::does_not_agree});
  }
}

// The paper says it of WCSPH at any alpha, so that even the quietest of its runs has to be noisier.
void add_pressure_oscillations(Table& table, const ReportData& data) {
  const ShownSensors shown = shown_sensors(data, SensorKind::pressure);
  if (shown.names.empty()) return;
  const auto noise_of = [&](const AnalysedRun& run) {
    return mean_over(shown.names, run, [&](const SensorReading& r) { return noise_after_impact(data, r); });
  };
  for (const WallsScope& scope : walls_scopes(data)) {
    const Evidence ours = judge_least(data, scope, noise_of, [](const LeastOfBoth& l) {
      return fmt::format("noise MPS {} Pa ({}), quietest WCSPH {} Pa ({})", fixed(l.mps, 0), l.mps_run.key,
                         fixed(l.wcsph, 0), l.wcsph_run.label);
    });
    add(table, scope.named("MPS pressures oscillate less than WCSPH's"), shown.evidence, ours);
  }
  table.notes.push_back(
      "Oscillations of pressures: noise, the root mean square of what a 20 ms running mean takes away, from 0.1 s "
      "after the measured arrival (what one impact leaves would hide the rest) to 1.5 s, up to where the paper's text "
      "sees them; in the mean over the sensors that it shows.");
}

}  // namespace sluice::conclusions
