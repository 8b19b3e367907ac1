#include "reports/bias.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/quantity.h"

namespace sluice {

namespace {

using Measure = const Pair& (*)(const Comparison&);

const Pair& impulse_pair(const Comparison& c) {
  return c.impulse;
}
const Pair& smoothed_peak_pair(const Comparison& c) {
  return c.smoothed_peak;
}
/// Not of a probe in the reservoir, whose measured maximum is the filling that the case prescribes.
const Pair& wave_pair(const Comparison& c) {
  constexpr double filling_s = 0.1;
  static const Pair none;
  return c.peak_time_s.measured && *c.peak_time_s.measured < filling_s ? none : c.peak;
}
const Pair& arrival_pair(const Comparison& c) {
  return c.arrival_s;
}

/// Runs by method: solver, walls, and what they were given otherwise than the case has it. An ablation is a method of
/// its own and says nothing of the one that it cuts something from.
std::vector<RunGroup> methods(const ReportData& data) {
  std::vector<RunGroup> groups;
  std::set<std::string> seen;  // one run under two names is one prediction
  for (const AnalysedRun& run : data.runs) {
    if (ended_early(data, run)) continue;  // what comes late in it is not there
    const std::string title = run.group + parameters_text(changed_parameters(run.record, data.the_case));
    const std::string what =
        fmt::format("{} {} {} {}", title, run.record.l0_m, run.record.alpha().value_or(0), run.series_hash);
    if (!run.series_hash.empty() && !seen.insert(what).second) continue;
    auto found = std::find_if(groups.begin(), groups.end(), [&](const RunGroup& g) { return g.title == title; });
    if (found == groups.end()) found = groups.insert(groups.end(), {title, {}});
    found->runs.push_back(&run);
  }
  return groups;
}

std::vector<PredictedAndMeasured> pairs_of(const ReportData& data, const RunGroup& group, SensorKind kind, double scale,
                                           Measure measure) {
  std::vector<PredictedAndMeasured> pairs;
  for (const AnalysedRun* run : group.runs)
    for (const std::string& sensor : data.sensors(kind)) {
      const SensorReading* reading = run->primary(sensor);
      if (reading == nullptr) continue;
      const Pair& values = measure(reading->comparison);
      if (values.simulated && values.measured) pairs.push_back({scale * *values.simulated, scale * *values.measured});
    }
  return pairs;
}

void add(std::vector<BiasQuantity>& out, const ReportData& data, SensorKind kind, const std::string& what,
         const std::string& unit, double scale, Measure measure) {
  BiasQuantity quantity{fmt::format("{} [{}]", what, unit), unit, {}};
  for (const RunGroup& group : methods(data))
    if (auto pairs = pairs_of(data, group, kind, scale, measure); !pairs.empty())
      quantity.methods.push_back({group.title, std::move(pairs)});
  if (!quantity.methods.empty()) out.push_back(std::move(quantity));
}

}  // namespace

std::vector<BiasQuantity> bias_quantities(const ReportData& data) {
  std::vector<BiasQuantity> out;
  for (const auto& [kind, name] :
       {std::pair(SensorKind::pressure, "pressures"), std::pair(SensorKind::force, "forces")}) {
    const Quantity& q = quantity_of(kind);
    add(out, data, kind, fmt::format("Impulse of {}", name), q.drawn_unit + " s", q.drawn_scale, impulse_pair);
    add(out, data, kind, fmt::format("10 ms mean peak of {}", name), q.drawn_unit, q.drawn_scale, smoothed_peak_pair);
    add(out, data, kind, fmt::format("Arrival at {}", name), "s", 1, arrival_pair);
  }
  const Quantity& wave = quantity_of(SensorKind::wave_height);
  add(out, data, SensorKind::wave_height, "Highest wave", wave.drawn_unit, wave.drawn_scale, wave_pair);
  return out;
}

}  // namespace sluice
