// What the runs show, in sentences whose every number is computed from them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/sections.h"
#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

struct Ranked {
  const AnalysedRun* run = nullptr;
  double value = 0;
};

/// Runs that have the value, smallest magnitude first. One that ended early does not stand beside whole ones.
template <class Value>
std::vector<Ranked> ranked(const ReportData& data, Value value) {
  const auto is_early = [&](const AnalysedRun& run) { return ended_early(data, run); };
  const bool all_early = std::all_of(data.runs.begin(), data.runs.end(), is_early);
  std::vector<Ranked> out;
  for (const AnalysedRun& run : data.runs) {
    if (!all_early && is_early(run)) continue;
    if (const std::optional<double> v = value(run)) out.push_back({&run, *v});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Ranked& a, const Ranked& b) { return std::abs(a.value) < std::abs(b.value); });
  return out;
}

std::vector<Ranked> by_impulse(const ReportData& data) {
  return ranked(data, [&](const AnalysedRun& run) { return mean_impulse_error(data, run); });
}

std::vector<Ranked> by_arrival(const ReportData& data, const std::string& sensor) {
  return ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
    const SensorReading* reading = run.primary(sensor);
    return reading == nullptr ? std::nullopt : reading->comparison.arrival_s.difference();
  });
}

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

/// The paper's mean unsigned deviations over the solver's printed alphas: smallest and largest.
std::optional<std::pair<double, double>> published_span(const ReportData& data, const std::string& solver) {
  std::vector<std::optional<double>> alphas;
  for (const PublishedImpulse& row : data.the_case.published.impulses)
    if (row.source == solver && std::find(alphas.begin(), alphas.end(), row.alpha) == alphas.end())
      alphas.push_back(row.alpha);
  std::vector<double> means;
  for (const auto& alpha : alphas) {
    if (const auto mean = published_mean(data, solver, alpha)) means.push_back(*mean);
  }
  if (means.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(means.begin(), means.end());
  return std::pair(*low, *high);
}

std::string impulse_finding(const ReportData& data) {
  const auto runs = by_impulse(data);
  const std::string sensors = list(data.headline_sensors());
  if (runs.empty()) return fmt::format("**Impulses** of {}: missing in every run.", sensors);
  std::string out = fmt::format("**Impulses** of {}: ", sensors);
  if (runs.size() == 1)
    out += fmt::format("{} is off by {} on average.", runs.front().run->label, percent(runs.front().value));
  else
    out += fmt::format("best {} with a mean unsigned deviation of {}, worst {} with {}.", runs.front().run->label,
                       percent(runs.front().value), runs.back().run->label, percent(runs.back().value));
  for (const auto& [solver, name] : {std::pair("wcsph", "WCSPH"), std::pair("mps", "MPS")})
    if (const auto span = published_span(data, solver))
      out += span->first == span->second
                 ? fmt::format(" The paper's {}: {}.", name, percent(span->first))
                 : fmt::format(" The paper's {}: {} to {}.", name, percent(span->first), percent(span->second));
  return out;
}

std::string arrival_finding(const ReportData& data) {
  const std::string sensor = data.headline_sensors().front();
  const auto runs = by_arrival(data, sensor);
  if (runs.empty()) return fmt::format("**Arrival** at {}: missing in every run.", sensor);
  const Pair pair = runs.front().run->primary(sensor)->comparison.arrival_s;
  std::string out = fmt::format("**Arrival** of the wave at {}: measured at {} s; ", sensor, fixed(*pair.measured, 3));
  out +=
      fmt::format("simulated − measured {} ms in {}", with_sign(1000 * runs.front().value, 0), runs.front().run->label);
  if (runs.size() > 1)
    out += fmt::format(" (closest), {1} ms in {0} (farthest)", runs.back().run->label,
                       with_sign(1000 * runs.back().value, 0));
  return out + ".";
}

std::string peak_finding(const ReportData& data) {
  const std::string sensor = data.headline_sensors().front();
  const auto runs = ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
    const SensorReading* reading = run.primary(sensor);
    return reading == nullptr ? std::nullopt : reading->comparison.smoothed_peak.deviation();
  });
  if (runs.empty()) return "";
  const Comparison& best = runs.front().run->primary(sensor)->comparison;
  std::string out = fmt::format("**Peak** at {}, after a 10 ms running mean: measured {} kPa; {} gives {} kPa", sensor,
                                fixed(*best.smoothed_peak.measured / 1000, 1), runs.front().run->label,
                                fixed(*best.smoothed_peak.simulated / 1000, 1));
  if (runs.size() > 1) {
    const Comparison& worst = runs.back().run->primary(sensor)->comparison;
    out += fmt::format(" (closest), {} {} kPa (farthest)", runs.back().run->label,
                       fixed(*worst.smoothed_peak.simulated / 1000, 1));
  }
  return out + ".";
}

std::string wave_finding(const ReportData& data) {
  std::string out;
  for (const std::string& sensor : data.sensors(SensorKind::wave_height)) {
    const auto runs = ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
      const SensorReading* reading = run.primary(sensor);
      return reading == nullptr ? std::nullopt : reading->comparison.rmse_over_range;
    });
    if (runs.empty()) continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", sensor, percent(runs.front().value));
    out += runs.size() > 1 ? fmt::format(" ({}) to {} ({})", runs.front().run->key, percent(runs.back().value),
                                         runs.back().run->key)
                           : fmt::format(" ({})", runs.front().run->key);
  }
  return out.empty() ? "" : "**Wave heights**, RMSE over the measured range: " + out + ".";
}

/// "simulated 31.2 N (R1), -4.7 %" or, of several runs, the closest and the farthest; without a measurement the span.
std::string force_quantity(const ReportData& data, const std::string& sensor, const std::string& unit, int decimals,
                           Pair Comparison::*quantity) {
  const auto pair_of = [&](const AnalysedRun& run) -> const Pair& { return run.primary(sensor)->comparison.*quantity; };
  const bool measured = data.measured_series(sensor) != nullptr;
  const auto runs = ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
    if (run.primary(sensor) == nullptr) return std::nullopt;
    return measured ? pair_of(run).deviation() : pair_of(run).simulated;
  });
  if (runs.empty()) return "missing in every run";
  const auto words = [&](const AnalysedRun& run) {
    const Pair& pair = pair_of(run);
    const std::string value = fmt::format("{} {} ({}", fixed(*pair.simulated, decimals), unit, run.key);
    return measured ? fmt::format("{}, {} %)", value, with_sign(100 * *pair.deviation(), 1)) : value + ")";
  };
  std::string out =
      measured ? fmt::format("measured {} {}; ", fixed(*pair_of(*runs.front().run).measured, decimals), unit) : "";
  out += words(*runs.front().run);
  return runs.size() > 1 ? out + " to " + words(*runs.back().run) : out;
}

std::string half_peak_words(const ReportData& data, const std::string& sensor) {
  const auto runs = ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
    const SensorReading* reading = run.primary(sensor);
    return reading == nullptr ? std::nullopt : reading->comparison.half_peak_s.difference();
  });
  if (runs.empty()) return "";
  std::string out = fmt::format("; time of half the measured peak, simulated − measured: {} ms ({})",
                                with_sign(1000 * runs.front().value, 0), runs.front().run->key);
  if (runs.size() == 1) return out;
  return out + fmt::format(" to {} ms ({})", with_sign(1000 * runs.back().value, 0), runs.back().run->key);
}

std::string force_finding(const ReportData& data, const std::string& sensor) {
  const Window window = data.window_of(sensor);
  return fmt::format("**Force** {}{}: peak after a 10 ms running mean {}; impulse over {} to {} s {}{}.", sensor,
                     data.measured_series(sensor) == nullptr ? " (measured: missing)" : "",
                     force_quantity(data, sensor, "N", 2, &Comparison::smoothed_peak), shortest(window.begin_s),
                     shortest(window.end_s), force_quantity(data, sensor, "N s", 2, &Comparison::impulse),
                     half_peak_words(data, sensor));
}

std::string lost_finding(const ReportData& data) {
  double through = 0;
  std::vector<std::string> leaking;
  std::vector<std::string> silent;
  std::vector<std::string> early;
  for (const AnalysedRun& run : data.runs) {
    const auto lost = run.record.number("lost.through_walls");
    if (!lost)
      silent.push_back(run.key);
    else if (*lost > 0)
      leaking.push_back(run.key);
    through += lost.value_or(0);
    if (ended_early(data, run)) early.push_back(run.key);
  }
  std::string out = "**Particles through walls**: ";
  if (silent.size() == data.runs.size()) return out + "missing in every run.";
  out += through > 0 ? fmt::format("{} in {}, an error of the method.", grouped(std::llround(through)), list(leaking))
                     : "none.";
  if (!silent.empty()) out += " Missing in " + list(silent) + ".";
  return early.empty() ? out : out + " Ended early: " + list(early) + ".";
}

/// How far walls and probe explain an error: of the pairs of runs, the one at the finest resolution and, of those, the
/// one whose first run is nearest the measurement.
std::string walls_finding(const ReportData& data) {
  const std::pair<const AnalysedRun*, const AnalysedRun*>* best = nullptr;
  const auto pairs = wall_pairs(data);
  auto key = [&](const auto& pair) {
    return std::pair(pair.first->record.l0_m, mean_impulse_error(data, *pair.first).value_or(1e9));
  };
  for (const auto& pair : pairs) {
    if (ended_early(data, *pair.first) || ended_early(data, *pair.second)) continue;
    if (best == nullptr || key(pair) < key(*best)) best = &pair;
  }
  if (best == nullptr) return "";
  std::vector<std::string> parts;
  for (const AnalysedRun* run : {best->first, best->second})
    for (const SensorReading* reading : run->of(data.headline_sensors().front())) {
      if (reading->warning_only) continue;
      if (const auto error = mean_impulse_error(data, *run, reading->model))
        parts.push_back(
            fmt::format("{} walls read by {} {}", run->record.walls, reading->model_name(), percent(*error)));
    }
  if (const auto paper = published_mean(data, "wcsph", best->first->record.alpha()))
    parts.push_back(fmt::format("the paper's WCSPH (dynamic walls, kernel{}) {}", published_distance(data, "wcsph"),
                                percent(*paper)));
  if (parts.size() < 2) return "";
  return fmt::format(
      "**Walls and probe**, mean unsigned deviation of the impulses in {} and {}: {} ([all pairs](#walls)).",
      best->first->label, best->second->key, list(parts));
}

}  // namespace

std::vector<std::string> findings(const ReportData& data) {
  std::vector<std::string> out;
  for (const std::string& sensor : data.sensors(SensorKind::force)) out.push_back(force_finding(data, sensor));
  if (data.has(SensorKind::pressure)) {
    out.push_back(impulse_finding(data));
    out.push_back(arrival_finding(data));
    out.push_back(peak_finding(data));
  }
  out.push_back(wave_finding(data));
  if (data.has(SensorKind::pressure)) out.push_back(walls_finding(data));
  out.push_back(lost_finding(data));
  const AcceptanceCount count = count_acceptance(data);
  if (count.passed + count.failed + count.missing > 0)
    out.push_back(fmt::format("**Acceptance**: {} passed, {} failed, {} could not be evaluated ([rows](#acceptance)).",
                              count.passed, count.failed, count.missing));
  std::erase(out, "");
  return out;
}

namespace {

void add_force_keys(std::vector<KeyNumber>& keys, const ReportData& data) {
  for (const std::string& sensor : data.sensors(SensorKind::force)) {
    const bool measured = data.measured_series(sensor) != nullptr;
    const auto runs = ranked(data, [&](const AnalysedRun& run) -> std::optional<double> {
      const SensorReading* reading = run.primary(sensor);
      if (reading == nullptr) return std::nullopt;
      const Pair& peak = reading->comparison.smoothed_peak;
      return measured ? peak.deviation() : peak.simulated;
    });
    if (runs.empty()) continue;
    const std::string run = runs.front().run->label;
    keys.push_back(measured
                       ? KeyNumber{"Peak of " + sensor, with_sign(100 * runs.front().value, 1) + " %",
                                   "after a 10 ms running mean, closest run: " + run}
                       : KeyNumber{"Peak of " + sensor, fixed(runs.front().value, 2) + " N",
                                   "after a 10 ms running mean, smallest of the runs: " + run + "; measured: missing"});
  }
}

}  // namespace

std::vector<KeyNumber> key_numbers(const ReportData& data) {
  std::vector<KeyNumber> keys;
  add_force_keys(keys, data);
  const auto runs = by_impulse(data);
  if (!runs.empty())
    keys.push_back({"Impulses of " + list(data.headline_sensors()), percent(runs.front().value),
                    "mean unsigned deviation, best run: " + runs.front().run->label});
  if (const auto span = published_span(data, "wcsph"))
    keys.push_back({runs.empty() ? "Impulses of " + list(data.headline_sensors()) + " in the paper (WCSPH)"
                                 : "The same in the paper (WCSPH)",
                    span->first == span->second ? percent(span->first)
                                                : fixed(100 * span->first, 1) + " – " + percent(span->second),
                    "over its values of α"});
  if (!data.headline_sensors().empty()) {
    const std::string sensor = data.headline_sensors().front();
    if (const auto arrivals = by_arrival(data, sensor); !arrivals.empty())
      keys.push_back({"Arrival at " + sensor, with_sign(1000 * arrivals.front().value, 0) + " ms",
                      "simulated − measured, closest run: " + arrivals.front().run->label});
  }
  const AcceptanceCount count = count_acceptance(data);
  const int all = count.passed + count.failed + count.missing;
  if (all > 0)
    keys.push_back({"Acceptance", fmt::format("{} of {}", count.passed, all),
                    count.missing == 0
                        ? "rows passed, over all runs"
                        : fmt::format("rows passed, over all runs; {} could not be evaluated", count.missing)});
  return keys;
}

}  // namespace sluice
