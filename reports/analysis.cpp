#include "reports/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "reports/run_problems.h"
#include "reports/text.h"
#include "validation/curve.h"
#include "validation/file_hash.h"
#include "validation/legs.h"
#include "validation/printable.h"
#include "validation/solver_factory.h"

namespace sluice {

namespace {

/// Our own solvers have names that are abbreviations; those of other codes stay as their owners write them.
std::string solver_name(const RunRecord& record) {
  return record.own ? in_capitals(record.solver) : record.solver;
}

/// A path that says nothing about the machine: relative to the working directory, or the last component.
std::string shown_directory(const std::filesystem::path& path) {
  if (path.is_relative()) return path.lexically_normal().generic_string();
  const std::filesystem::path relative = path.lexically_relative(std::filesystem::current_path());
  if (!relative.empty() && *relative.begin() != "..") return relative.generic_string();
  const std::filesystem::path clean = path.lexically_normal();
  return (clean.has_filename() ? clean.filename() : clean.parent_path().filename()).generic_string();
}

SensorReading make_reading(const Case& c, const CaseSensor& sensor, const std::string& model, Series series,
                           const MeasuredSeries* measured) {
  const Window window = comparison_window(c, sensor);
  SensorReading reading;
  reading.sensor = sensor.name;
  reading.kind = sensor.kind;
  reading.model = model;
  reading.series = std::move(series);
  if (reading.series.t_s.empty()) {
    reading.comparison.remarks.push_back("no samples");
    return reading;
  }
  reading.comparison = measured != nullptr ? compare(reading.series, *measured, window, comparison_options(sensor))
                                           : describe(reading.series, window);
  return reading;
}

void read_sensor(AnalysedRun& run, const Case& c, const CaseSensor& sensor, const MeasuredSeries* measured) {
  std::vector<std::string> models;
  for (const std::string& column : run.record.probes.names())
    if (const auto model = model_of(column, sensor)) models.push_back(*model);
  const std::string primary = run.record.text("sensors." + sensor.name + ".primary").value_or("");
  const bool named = !primary.empty() && std::find(models.begin(), models.end(), primary) != models.end();
  for (const std::string& model : models) {
    if (model.empty() && named) continue;  // repeats the primary model's column
    run.readings.push_back(
        make_reading(c, sensor, model, run.record.probes.column(probe_column(sensor, model)), measured));
    // A dynamic wall's density can rise but never fall below the reference: its own pressure means nothing.
    run.readings.back().warning_only =
        run.record.walls == "dynamic" && (model == "wall" || (sensor.kind == SensorKind::force && model == "pressure"));
    run.readings.back().primary = named ? model == primary : model.empty() || models.size() == 1;
  }
}

/// Own runs first, then as a reader would look them up.
bool comes_before(const RunRecord& a, const RunRecord& b) {
  auto order = [](const RunRecord& r) {
    return std::make_tuple(!r.own, r.solver, r.walls != "extrapolated", r.walls, -r.l0_m,
                           -r.alpha().value_or(std::numeric_limits<double>::infinity()), r.path);
  };
  return order(a) < order(b);
}

void name_run(AnalysedRun& run, std::size_t index, const Case& c) {
  const RunRecord& r = run.record;
  run.key = fmt::format("R{}", index + 1);
  run.group = solver_name(r) + (r.walls.empty() ? "" : ", " + r.walls + " walls");
  const std::string alpha = r.alpha() ? fmt::format("α = {}", shortest(*r.alpha())) : "";
  const std::string changed = parameters_text(changed_parameters(r, c));
  const std::string rest = fmt::format("{}{}l0 {:g} mm{}", alpha, alpha.empty() ? "" : ", ", 1000 * r.l0_m, changed);
  run.short_label = run.key + " " + rest;
  run.method_label = fmt::format("{} {}{}{}{}", run.key, solver_name(r), alpha.empty() ? "" : ", ", alpha, changed);
  run.label = fmt::format("{} {}{}, {}", run.key, solver_name(r), r.walls.empty() ? "" : " " + r.walls, rest);
  run.directory = shown_directory(r.path);
}

std::vector<RunRecord> read_runs(const std::vector<std::filesystem::path>& run_directories) {
  if (run_directories.empty())
    throw std::runtime_error("report: no run directory given (remedy: sluice report DIR...)");
  std::vector<RunRecord> records;
  std::set<std::filesystem::path> read;  // patterns of a shell overlap; a run counts once
  for (const auto& directory : run_directories)
    if (read.insert(std::filesystem::weakly_canonical(directory)).second) records.push_back(read_run(directory));
  for (const RunRecord& record : records)
    if (record.case_name != records.front().case_name)
      throw std::runtime_error(fmt::format(
          "report: {} is of case {}, {} of case {}; a report compares runs of one case (remedy: one report a case)",
          records.front().path.string(), records.front().case_name, record.path.string(), record.case_name));
  std::sort(records.begin(), records.end(), comes_before);
  return records;
}

/// The case file that the runs were made with: the project's own by its name, another where it was read from.
Case case_of(const std::vector<RunRecord>& records) {
  for (const RunRecord& record : records) {
    const std::optional<std::string> file = record.text("case_file");
    if (!file) continue;
    if (std::error_code none; std::filesystem::exists(*file, none)) return load_case(*file);
    const std::vector<std::string> names = case_names();
    if (std::find(names.begin(), names.end(), record.case_name) == names.end())
      throw std::runtime_error(
          fmt::format("{}: case_file: {} is not there (put the case file back, or write its new place here)",
                      (record.path / "run.json").string(), *file));
  }
  return load_case(records.front().case_name);
}

}  // namespace

std::optional<std::string> model_of(const std::string& column, const CaseSensor& sensor) {
  const std::string prefix = sensor.name + "_";
  const std::string suffix = fmt::format("_{}", unit_of(sensor.kind));
  if (column == probe_column(sensor)) return "";
  if (!column.starts_with(prefix) || !column.ends_with(suffix)) return std::nullopt;
  if (column.size() <= prefix.size() + suffix.size()) return std::nullopt;
  return column.substr(prefix.size(), column.size() - prefix.size() - suffix.size());
}

std::string SensorReading::remarked_model() const {
  if (warning_only) return model_name() + " (warning only)";
  return model_name() + (primary && !model.empty() ? " (primary)" : "");
}

const SensorReading* AnalysedRun::primary(const std::string& sensor) const {
  for (const SensorReading& reading : readings)
    if (reading.sensor == sensor && reading.primary) return &reading;
  return nullptr;
}

const SensorReading* AnalysedRun::find(const std::string& sensor, const std::string& model) const {
  for (const SensorReading& reading : readings)
    if (reading.sensor == sensor && reading.model == model) return &reading;
  return nullptr;
}

std::vector<const SensorReading*> AnalysedRun::of(const std::string& sensor) const {
  std::vector<const SensorReading*> found;
  for (const SensorReading& reading : readings)
    if (reading.sensor == sensor) found.push_back(&reading);
  std::stable_sort(found.begin(), found.end(), [](auto* a, auto* b) { return a->primary > b->primary; });
  return found;
}

const MeasuredSeries* ReportData::measured_series(const std::string& sensor) const {
  return measured.find(sensor);
}

Window ReportData::window_of(const std::string& sensor) const {
  const CaseSensor* found = the_case.find_sensor(sensor);
  return found == nullptr ? window : comparison_window(the_case, *found);
}

std::string ReportData::measured_remark(const std::string& sensor) const {
  const CaseSensor* found = the_case.find_sensor(sensor);
  if (found == nullptr || measured_series(sensor) == nullptr) return "Measured: missing.";
  std::string remark;
  if (found->measured_shift_s != 0)
    remark =
        fmt::format("{} s were added to the measured times, as the case declares.", shortest(found->measured_shift_s));
  if (const Window w = window_of(sensor); !covers(*measured_series(sensor), w))
    remark += fmt::format("{}The measured series does not run over {} to {} s: what needs all of it is missing.",
                          remark.empty() ? "" : " ", shortest(w.begin_s), shortest(w.end_s));
  return remark;
}

std::vector<std::string> ReportData::sensors(SensorKind kind) const {
  std::vector<std::string> names;
  for (const CaseSensor& sensor : the_case.sensors)
    if (sensor.kind == kind) names.push_back(sensor.name);
  return names;
}

std::vector<std::string> ReportData::headline_sensors() const {
  std::vector<std::string> names;
  for (const PublishedImpulse& row : the_case.published.impulses)
    if (std::find(names.begin(), names.end(), row.sensor) == names.end()) names.push_back(row.sensor);
  if (names.empty()) names = sensors(SensorKind::pressure);
  return names.empty() ? sensors(SensorKind::force) : names;
}

ReportData analyse(const std::vector<std::filesystem::path>& run_directories, const std::filesystem::path& bands) {
  std::vector<RunRecord> records = read_runs(run_directories);
  ReportData data;
  data.the_case = case_of(records);
  if (!bands.empty()) add_bands(data.the_case, bands);
  data.window = {data.the_case.window.start_s, data.the_case.window.end_s};
  data.measured = Measurements::load(data.the_case);
  for (RunRecord& record : records) {
    AnalysedRun run;
    run.record = std::move(record);
    name_run(run, data.runs.size(), data.the_case);
    for (const CaseSensor& sensor : data.the_case.sensors)
      read_sensor(run, data.the_case, sensor, data.measured_series(sensor.name));
    // A run that failed at its start has no series.
    if (const auto series = run.record.path / "probes.csv"; std::filesystem::exists(series))
      run.series_hash = file_hash(series);
    run.acceptance = check_acceptance(data.the_case, run.record, data.measured);
    run.problems = run_problems(run, data);
    data.runs.push_back(std::move(run));
  }
  return data;
}

std::map<std::string, double> changed_parameters(const RunRecord& run, const Case& c) {
  const SolverOption* solver = c.find_solver(run.solver);
  if (!run.own || solver == nullptr) return {};
  std::map<std::string, double> defaults = solver->parameters;
  if (const WallOption* walls = find_walls(*solver, run.walls); walls != nullptr)
    for (const auto& [name, value] : walls->parameters) defaults[name] = value;
  // What the case leaves to the solver, such as a speed of sound that follows from the water's depth.
  if (has_solver(run.solver)) defaults = complete_parameters(c, run.solver, defaults);
  defaults.erase("alpha");
  for (const Placement& placement : c.placements) defaults[placement.name] = placement.drawn_m;
  std::map<std::string, double> changed;
  for (const auto& [name, value] : defaults)
    if (const auto used = run.number("parameters." + name); used && std::abs(*used - value) > 1e-9 * std::abs(value))
      changed[name] = *used;
  return changed;
}

std::string parameters_text(const std::map<std::string, double>& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) text += fmt::format(", {} = {}", name, shortest(value));
  return text;
}

bool is_whole(const ReportData& data, const RunRecord& run) {
  return run.own && run.status() == "finished" && run.number("t_end_s").value_or(0) >= data.window.end_s * (1 - 1e-9);
}

namespace {

bool reaches_windows_end(const ReportData& data, const AnalysedRun& run) {
  const std::vector<double>& t = run.record.probes.times_s();
  return reaches_end({t, t}, data.window);
}

}  // namespace

bool ended_early(const ReportData& data, const AnalysedRun& run) {
  const std::string status = run.record.status();
  if (run.record.own && !status.empty() && status != "finished") return true;
  if (reaches_windows_end(data, run)) return false;
  // A set of short runs alone is told about among themselves.
  return !run.record.own || std::any_of(data.runs.begin(), data.runs.end(),
                                        [&](const AnalysedRun& other) { return reaches_windows_end(data, other); });
}

std::string left_out_note(const ReportData& data) {
  std::string keys;
  for (const AnalysedRun& run : data.runs)
    if (ended_early(data, run)) keys += (keys.empty() ? "" : ", ") + run.key;
  return keys.empty() ? "" : fmt::format("Left out, since they ended early: {}.", keys);
}

std::optional<double> processor_time_s(const AnalysedRun& run) {
  if (const auto cpu_s = run.record.number("cpu_time_s"); cpu_s && *cpu_s > 0) return cpu_s;
  const auto wall_s = run.record.number("wall_time_s");
  if (!wall_s || *wall_s <= 0) return std::nullopt;
  return *wall_s * run.record.number("threads").value_or(1);
}

std::optional<std::string> machine_of(const AnalysedRun& run) {
  if (!difference_of_legs(run.record.manifest, {"machine"}).empty()) return std::nullopt;
  const auto machine = run.record.text("machine");
  return machine && !machine->empty() ? machine : std::nullopt;
}

std::optional<double> mean_impulse_error(const ReportData& data, const AnalysedRun& run, const std::string& model) {
  double sum = 0;
  int count = 0;
  for (const std::string& sensor : data.headline_sensors()) {
    const SensorReading* reading = model.empty() ? run.primary(sensor) : run.find(sensor, model);
    if (reading == nullptr) return std::nullopt;
    const std::optional<double> deviation = reading->comparison.impulse.deviation();
    if (!deviation) return std::nullopt;
    sum += std::abs(*deviation);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::vector<RunGroup> run_groups(const ReportData& data, std::size_t limit) {
  std::vector<RunGroup> groups;
  for (const AnalysedRun& run : data.runs) {
    if (groups.empty() || groups.back().title != run.group || groups.back().runs.size() >= limit)
      groups.push_back({run.group, {}});
    groups.back().runs.push_back(&run);
  }
  return groups;
}

}  // namespace sluice
