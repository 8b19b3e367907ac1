#include "ci/from_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "ci/early_flow.h"
#include "reports/analysis.h"
#include "validation/acceptance.h"
#include "validation/file_hash.h"
#include "validation/legs.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;

/// The metrics that are tracked for each primary reading; acceptance rows add theirs.
std::span<const std::string_view> tracked_metrics(SensorKind kind) {
  static constexpr std::array<std::string_view, 4> impacts{"impulse_deviation", "arrival_difference_s",
                                                           "smoothed_peak_deviation", "rmse_over_range"};
  static constexpr std::array<std::string_view, 3> levels{"rmse_over_range", "arrival_difference_s", "peak_deviation"};
  if (kind == SensorKind::pressure || kind == SensorKind::force) return impacts;
  return levels;
}

std::string_view unit_of_metric(std::string_view name) {
  for (const AcceptanceMetric& metric : acceptance_metrics())
    if (metric.name == name) return metric.unit;
  throw std::invalid_argument(fmt::format("unknown metric `{}`", name));
}

std::string first_of(std::initializer_list<std::string> candidates, const fs::path& directory, const char* what) {
  for (const std::string& candidate : candidates)
    if (!candidate.empty()) return candidate;
  throw std::runtime_error(
      fmt::format("{}: does not say its {} (give --{})", (directory / "run.json").string(), what, what));
}

/// "fnv1a64:0123" without the name of the method.
std::string short_hash(const std::string& hash) {
  return hash.substr(hash.find(':') + 1);
}

/// Collects the results of one run; what they have in common is filled in once.
class Collector {
 public:
  explicit Collector(Result common) : common_(std::move(common)) {}

  void add(std::string_view metric, const std::string& of, std::optional<double> value, std::string_view unit,
           const std::string& reason = "") {
    if (!known_.emplace(metric, of).second) return;
    Result& result = results_.emplace_back(common_);
    result.metric = metric;
    result.of = of;
    result.value = value;
    result.unit = unit;
    if (!value) result.reason = reason.empty() ? "no such value" : reason;
  }
  void add_if_stated(std::string_view metric, std::optional<double> value, std::string_view unit,
                     const std::string& of = "") {
    if (value) add(metric, of, value, unit);
  }

  std::vector<Result> take() { return std::move(results_); }

 private:
  Result common_;
  std::vector<Result> results_;
  std::set<std::pair<std::string, std::string>> known_;
};

nlohmann::json parameters_of(const RunRecord& run, const Case& c) {
  nlohmann::json parameters = {{"l0_m", run.l0_m}};
  if (!run.walls.empty()) parameters["walls"] = run.walls;
  if (const auto alpha = run.alpha()) parameters["alpha"] = *alpha;
  if (const auto t_end_s = run.number("t_end_s")) parameters["t_end_s"] = *t_end_s;
  for (const auto& [name, value] : changed_parameters(run, c)) parameters[name] = value;
  return parameters;
}

/// What tells a run from all others. A manifest of this project says when the run was begun; that of another code may
/// be the same line for line every night, so that its results, its commit and its date belong to the name.
std::string name_of(const RunRecord& run, const Provenance& given) {
  const std::string manifest = file_hash(run.path / "run.json");
  if (run.own) return short_hash(manifest);
  return short_hash(text_hash(manifest + file_hash(run.path / "probes.csv") + given.commit + given.date));
}

Result common_of(const RunRecord& run, const Case& c, const Provenance& given) {
  const auto stated = [&](const char* key) { return run.text(key).value_or(""); };
  const std::string cpu = stated("cpu");
  Result common;
  common.commit = first_of({given.commit, stated("commit")}, run.path, "commit");
  common.date = first_of({given.date, stated("started")}, run.path, "date");
  common.machine = first_of({given.machine, stated("machine"), cpu.empty() ? "" : cpu + ", processors not stated"},
                            run.path, "machine");
  common.compiler = given.compiler.empty() ? stated("compiler") : given.compiler;
  common.flags = given.flags.empty() ? stated("flags") : given.flags;
  common.threads = static_cast<int>(run.number("threads").value_or(0));
  if (!stated("case_hash").empty())
    common.inputs = short_hash(stated("case_hash")) + " " + short_hash(stated("data_hash"));
  common.case_name = run.case_name;
  common.solver = run.solver;
  common.parameters = parameters_of(run, c);
  common.run = name_of(run, given);
  common.link = given.link.empty() ? run.path.lexically_normal().generic_string() : given.link;
  if (!is_date(common.date))
    throw std::runtime_error(fmt::format("{}: `{}` is no date such as 2026-11-25T09:34:08Z (give --date)",
                                         (run.path / "run.json").string(), common.date));
  return common;
}

std::string reading_name(const std::string& sensor, const std::string& model) {
  return model.empty() ? sensor : sensor + " " + model;
}

double window_end_s(const Case& c, const std::string& sensor) {
  const CaseSensor* known = c.find_sensor(sensor);
  return known != nullptr ? comparison_window(c, *known).end_s : c.window.end_s;
}

/// A run that was asked to end before a window does owes no value there.
bool owes(const RunRecord& run, const Case& c, double end_s) {
  const auto asked_end_s = run.number("t_end_s");
  return !asked_end_s || *asked_end_s + 2 / c.output_rate_Hz >= end_s;
}

/// A row that looks at a window of its own is another series than the reading over the sensor's.
std::string accepted_name(const AcceptanceRow& row, const AnalysedRun& run) {
  const SensorReading* primary = row.model.empty() ? run.primary(row.sensor) : nullptr;
  const std::string name = reading_name(row.sensor, primary != nullptr ? primary->model : row.model);
  return row.window ? fmt::format("{} {}", name, window_text(*row.window)) : name;
}

/// Sensors of which a run of our own has no primary reading: its metrics are missing under the name that they always
/// had.
void add_unread_sensors(Collector& collector, const ReportData& data, const AnalysedRun& run) {
  const Case& c = data.the_case;
  const SolverOption* solver = c.find_solver(run.record.solver);
  if (!run.record.own || solver == nullptr || find_walls(*solver, run.record.walls) == nullptr) return;
  for (const CaseSensor& sensor : c.sensors) {
    if (run.primary(sensor.name) != nullptr || data.measured_series(sensor.name) == nullptr) continue;
    if (!owes(run.record, c, window_end_s(c, sensor.name))) continue;
    const std::string name = reading_name(sensor.name, primary_model(c, sensor, run.record.solver, run.record.walls));
    for (const std::string_view metric : tracked_metrics(sensor.kind))
      collector.add(metric, name, std::nullopt, unit_of_metric(metric), "probes.csv has no such column");
  }
}

void add_accuracy(Collector& collector, const ReportData& data, const AnalysedRun& run) {
  const auto mean_error = mean_impulse_error(data, run);
  if (!data.headline_sensors().empty() && (mean_error || owes(run.record, data.the_case, data.window.end_s)))
    collector.add("mean_impulse_error", "", mean_error, "1", "a headline sensor has no impulse deviation");
  for (const SensorReading& reading : run.readings) {
    if (!reading.primary || data.measured_series(reading.sensor) == nullptr) continue;
    const std::vector<std::string>& remarks = reading.comparison.remarks;
    const bool owed = owes(run.record, data.the_case, window_end_s(data.the_case, reading.sensor));
    for (const std::string_view metric : tracked_metrics(reading.kind)) {
      const auto value = sensor_metric(metric, reading.comparison);
      if (value || owed)
        collector.add(metric, reading_name(reading.sensor, reading.model), value, unit_of_metric(metric),
                      remarks.empty() ? "" : remarks.front());
    }
  }
  add_unread_sensors(collector, data, run);
  for (const AcceptanceCheck& check : run.acceptance) {
    const AcceptanceRow& row = check.row;
    if (check.verdict == AcceptanceVerdict::not_applicable) continue;
    const double end_s = row.window ? row.window->end_s : window_end_s(data.the_case, row.sensor);
    if (!check.value && !owes(run.record, data.the_case, end_s)) continue;
    collector.add(row.metric, accepted_name(row, run), check.value, unit_of_metric(row.metric), check.reason);
  }
  for (const AcceptanceMetric& metric : acceptance_metrics())
    if (!metric.needs_sensor) collector.add_if_stated(metric.name, run_metric(metric.name, run.record), metric.unit);
}

void add_early_flow(Collector& collector, const ReportData& data, const AnalysedRun& run) {
  const double end_s = early_flow_end_s(data.the_case.water_height_m, -data.the_case.gravity_m_s2.z);
  const auto flow = early_flow(run.record.probes, end_s);
  if (!flow) return;
  collector.add("kinetic_energy_share", "", flow->kinetic_energy_share, "1");
  collector.add("energy_lost_share", "", flow->energy_lost_share, "1");
  collector.add("compression", "", flow->compression, "1");
}

void add_cost(Collector& collector, const RunRecord& run) {
  struct Cost {
    const char* metric;
    const char* key;
    const char* unit;
  };
  static constexpr std::array<Cost, 7> costs{{{"cpu_time_s", "cpu_time_s", "s"},
                                              {"wall_time_s", "wall_time_s", "s"},
                                              {"particle_steps_per_s", "particle_steps_per_s", "1/s"},
                                              {"steps", "steps", "1"},
                                              {"iterations_mean", "facts.iterations_mean", "1"},
                                              {"bytes_per_particle", "bytes_per_particle", "B"},
                                              {"peak_memory_bytes", "peak_memory_bytes", "B"}}};
  for (const Cost& cost : costs) collector.add_if_stated(cost.metric, run.number(cost.key), cost.unit);
  const auto phases = run.manifest.find("phases");
  if (phases == run.manifest.end() || !phases->is_object()) return;
  for (const auto& [phase, time_s] : phases->items())
    if (time_s.is_number()) collector.add("phase_time_s", phase, time_s.get<double>(), "s");
}

/// Threads do not change results, only what they cost.
void refuse_several_builds(const RunRecord& run) {
  const std::string difference = difference_of_legs(run.manifest, {"commit", "compiler", "flags", "machine"});
  if (difference.empty()) return;
  throw std::runtime_error(
      fmt::format("{}: {}: its results belong to no single one (compute it anew: sluice run ... --force)",
                  run.path.string(), difference));
}

}  // namespace

std::vector<Result> results_of_run(const fs::path& directory, const Provenance& given) {
  const ReportData data = analyse({directory});
  const AnalysedRun& run = data.runs.front();
  const std::string status = run.record.status();
  if (status == "running")
    throw std::runtime_error(fmt::format("{}: the run is still going on, or was killed (finish it: sluice resume {})",
                                         directory.string(), directory.string()));
  Collector collector(common_of(run.record, data.the_case, given));
  const bool finished = status.empty() || status == "finished";
  if (!status.empty()) collector.add("finished", "", finished ? 1 : 0, "1");
  if (finished) {
    refuse_several_builds(run.record);
    add_accuracy(collector, data, run);
    add_early_flow(collector, data, run);
    if (difference_of_legs(run.record.manifest, {"threads"}).empty() && !ended_early(data, run))
      add_cost(collector, run.record);
  }
  return collector.take();
}

}  // namespace sluice::ci
