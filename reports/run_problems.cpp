#include "reports/run_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "reports/text.h"
#include "validation/suggest.h"

namespace sluice {

namespace {

using Problems = std::vector<std::string>;

void note_ending(Problems& problems, const RunRecord& record) {
  if (record.status() == "running") problems.push_back("still running when the report was made");
  if (record.status() == "interrupted") problems.push_back("interrupted before its end");
  if (record.status() == "failed") problems.push_back("failed: " + record.text("error").value_or("no reason recorded"));
}

void note_other_case(Problems& problems, const RunRecord& record, const Case& c) {
  const auto hash = record.text("case_hash");
  const std::string computed = record.text("computed_hash").value_or("");
  if (!hash || has_inputs_of(c, computed, *hash)) return;
  problems.push_back(
      fmt::format("made with another version of the case file ({}; this report reads {}){}", *hash, c.hash,
                  computed.empty() ? "" : ", which differs in what is computed, not in words or bands alone"));
}

void note_coverage(Problems& problems, const RunRecord& record, const ReportData& data) {
  constexpr double longest_run = 100;  // over the case's; milliseconds under the name of seconds
  const std::vector<double>& times = record.probes.times_s();
  if (times.empty())
    problems.push_back("probes.csv has no rows");
  else if (const std::string remark = coverage_remark({times, times}, data.window); !remark.empty())
    problems.push_back(remark + ": what needs the whole window is missing");
  else if (times.back() > longest_run * data.the_case.t_end_s)
    problems.push_back(fmt::format("ends at {} s, the case at {} s: are its times in s?", significant(times.back(), 2),
                                   significant(data.the_case.t_end_s, 2)));
}

/// Columns that no sensor reads and that have a use all the same.
bool is_known_without_sensor(const std::string& column) {
  static constexpr std::array<std::string_view, 3> totals{"kinetic_energy_J", "potential_energy_J",
                                                          "greatest_density_ratio_1"};
  return std::find(totals.begin(), totals.end(), column) != totals.end() || column.ends_with("_kernel_support_1");
}

/// Of another code: names that are not a sensor's would else be missing in every table without a word.
void note_unread_columns(Problems& problems, const AnalysedRun& run, const Case& c) {
  constexpr std::size_t most = 5;
  if (run.record.own) return;
  Problems unread;
  for (const std::string& column : run.record.probes.names()) {
    const bool read = std::any_of(c.sensors.begin(), c.sensors.end(),
                                  [&](const CaseSensor& sensor) { return model_of(column, sensor).has_value(); });
    if (!read && !is_known_without_sensor(column)) unread.push_back(column);
  }
  std::vector<std::string> known;
  for (const CaseSensor& sensor : c.sensors) known.push_back(probe_column(sensor));
  for (std::size_t i = 0; i < std::min(most, unread.size()); ++i) {
    const auto meant = closest(unread[i], known);
    problems.push_back(fmt::format("column {} belongs to no sensor of the case and is not read{}", unread[i],
                                   meant ? fmt::format(" (did you mean {}?)", *meant) : ""));
  }
  if (unread.size() > most) problems.push_back(fmt::format("{} more columns are not read", unread.size() - most));
}

void note_nothing_primary(Problems& problems, const AnalysedRun& run, const Case& c) {
  for (const CaseSensor& sensor : c.sensors)
    if (const auto readings = run.of(sensor.name); !readings.empty() && run.primary(sensor.name) == nullptr)
      problems.push_back(
          fmt::format("{} has columns of {} models, none of them the one to be judged (name it in run.json: "
                      "\"sensors\": {{ \"{}\": {{ \"primary\": \"{}\" }} }})",
                      sensor.name, readings.size(), sensor.name, readings.front()->model));
}

/// Pressures in kPa under the name of Pa, heights in millimetres: off by a factor that no physics explains.
void note_doubtful_units(Problems& problems, const AnalysedRun& run, const ReportData& data) {
  constexpr double too_much = 150;
  for (const SensorReading& reading : run.readings) {
    const MeasuredSeries* measured = data.measured_series(reading.sensor);
    if (!reading.primary || reading.warning_only || measured == nullptr || measured->maximum.empty() ||
        reading.series.value.empty())
      continue;
    const double ratio = *std::max_element(reading.series.value.begin(), reading.series.value.end()) /
                         *std::max_element(measured->maximum.begin(), measured->maximum.end());
    if (ratio > too_much || (ratio > 0 && ratio < 1 / too_much))
      problems.push_back(fmt::format("{} peaks at {} times the measured value: is its unit {}?", reading.sensor,
                                     significant(ratio, 2), reading.comparison.unit));
  }
}

/// A gauge that reads before the water comes: the air's pressure is in it, or another datum.
void note_doubtful_datum(Problems& problems, const AnalysedRun& run, const ReportData& data) {
  constexpr double dry_s = 0.05;  // before the measured arrival
  for (const SensorReading& reading : run.readings) {
    const auto arrival_s = reading.comparison.arrival_s.measured;
    const MeasuredSeries* measured = data.measured_series(reading.sensor);
    if (reading.kind != SensorKind::pressure || !reading.primary || reading.warning_only || measured == nullptr ||
        !arrival_s)
      continue;
    const Window dry{data.window_of(reading.sensor).begin_s, *arrival_s - dry_s};
    const auto sum = dry.end_s > dry.begin_s ? impulse(reading.series, dry) : std::nullopt;
    const auto top = peak(*measured, data.window_of(reading.sensor));
    if (!sum || !top) continue;
    const double mean = *sum / (dry.end_s - dry.begin_s);
    const double own_top = *std::max_element(reading.series.value.begin(), reading.series.value.end());
    if (mean > std::max(top->value, 0.5 * own_top))
      problems.push_back(
          fmt::format("{} reads {} {} before the wave comes, more than the measured peak: is the air's "
                      "pressure in it (give an offset)?",
                      reading.sensor, significant(mean, 6), reading.comparison.unit));
  }
}

/// Millimetres under the name of metres.
void note_doubtful_distance(Problems& problems, const RunRecord& record, const Case& c) {
  const bool fits = std::any_of(c.fluid.begin(), c.fluid.end(), [&](const Box& fluid) {
    const Vec3d size = fluid.upper - fluid.lower;
    return record.l0_m <= std::max({size.x, size.y, size.z});
  });
  if (!fits)
    problems.push_back(fmt::format("l0_m is {}, more than the fluid is long: is it in m?", shortest(record.l0_m)));
}

/// Peaks and running means of 10 ms need rows closer than that.
void note_sampling(Problems& problems, const RunRecord& record, Window window) {
  constexpr double coarse_s = 0.0105;
  const std::vector<double>& times = record.probes.times_s();
  const Curve rows{times, times};
  if (first_gap(rows, window)) return;  // told already
  constexpr double much = 0.1;
  double all_s = 0;
  double coarse_rows_s = 0;
  double longest_s = 0;
  int intervals = 0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (times[k] <= window.begin_s || times[k - 1] >= window.end_s) continue;
    const double interval_s = times[k] - times[k - 1];
    ++intervals;
    all_s += interval_s;
    longest_s = std::max(longest_s, interval_s);
    if (interval_s > coarse_s) coarse_rows_s += interval_s;
  }
  if (intervals < 2) return;
  if (coarse_rows_s > much * all_s)
    problems.push_back(fmt::format(
        "has rows more than 10 ms apart over {} % of its time (up to {} ms): of peaks, running means of 10 ms, noise "
        "and arrivals it says little",
        significant(100 * coarse_rows_s / all_s, 2), significant(1000 * longest_s, 2)));
  else if (const auto gap = first_gap(rows, window, coarse_s))
    problems.push_back(fmt::format("has no row for {} ms from {} s on: a peak there is not seen",
                                   significant(1000 * (gap->end_s - gap->begin_s), 2), significant(gap->begin_s, 4)));
}

/// One run under two names counts twice.
void note_twin(Problems& problems, const AnalysedRun& run, const ReportData& data) {
  const auto twin = std::find_if(data.runs.begin(), data.runs.end(),
                                 [&](const AnalysedRun& other) { return other.series_hash == run.series_hash; });
  if (twin != data.runs.end() && !run.record.probes.times_s().empty())
    problems.push_back(fmt::format("its series are those of {}, byte for byte: one run under two names?", twin->key));
}

void note_lost(Problems& problems, const RunRecord& record) {
  if (record.number("lost.through_walls").value_or(0) > 0)
    problems.push_back(fmt::format("fluid particles that went through a wall, an error of the method: {}",
                                   grouped(std::llround(*record.number("lost.through_walls")))));
}

}  // namespace

std::vector<std::string> run_problems(const AnalysedRun& run, const ReportData& data) {
  Problems problems;
  note_ending(problems, run.record);
  note_other_case(problems, run.record, data.the_case);
  note_coverage(problems, run.record, data);
  note_sampling(problems, run.record, data.window);
  note_twin(problems, run, data);
  note_unread_columns(problems, run, data.the_case);
  note_nothing_primary(problems, run, data.the_case);
  note_doubtful_units(problems, run, data);
  note_doubtful_datum(problems, run, data);
  note_doubtful_distance(problems, run.record, data.the_case);
  note_lost(problems, run.record);
  return problems;
}

}  // namespace sluice
