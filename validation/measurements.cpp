#include "validation/measurements.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/file_hash.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

MeasuredSeries shifted(MeasuredSeries series, double shift_s) {
  for (double& t : series.t_s) t += shift_s;
  return series;
}

}  // namespace

std::vector<MeasuredFile> measured_files(const Case& c) {
  std::vector<MeasuredFile> files;
  for (const CaseSensor& sensor : c.sensors) {
    const fs::path& named = c.measured_file(sensor);
    const auto same = [&](const MeasuredFile& other) { return other.path == named; };
    if (named.empty() || std::any_of(files.begin(), files.end(), same)) continue;
    const fs::path file = resolve_in_source_tree(named);
    files.push_back({named, fs::exists(file) ? file_hash(file) : ""});
  }
  return files;
}

Measurements Measurements::load(const Case& c) {
  Measurements all;
  all.files_ = measured_files(c);
  std::map<fs::path, MeasuredData> digests;
  for (const MeasuredFile& file : all.files_) {
    if (file.present())
      digests.emplace(file.path, MeasuredData::load(resolve_in_source_tree(file.path)));
    else
      all.problems_.push_back(
          fmt::format("{0} does not exist (remedy: {1}/README.md says what it holds, and how to make it)",
                      file.path.generic_string(), file.path.parent_path().generic_string()));
  }
  for (const CaseSensor& sensor : c.sensors) {
    const auto digest = digests.find(c.measured_file(sensor));
    if (digest == digests.end()) continue;
    if (!digest->second.has(sensor.measured)) {
      all.problems_.push_back(fmt::format("{} has no series {}, which the case names for sensor {}",
                                          digest->first.generic_string(), sensor.measured, sensor.name));
      continue;
    }
    const MeasuredSeries& series = digest->second.series(sensor.measured);
    if (series.unit != unit_of(sensor.kind))
      all.problems_.push_back(fmt::format("{}: {} is in {}, sensor {} in {} (make the digest anew in that unit)",
                                          digest->first.generic_string(), sensor.measured, series.unit, sensor.name,
                                          unit_of(sensor.kind)));
    else
      all.series_.emplace(sensor.name, shifted(series, sensor.measured_shift_s));
  }
  return all;
}

const MeasuredSeries* Measurements::find(std::string_view sensor) const {
  const auto found = series_.find(sensor);
  return found == series_.end() ? nullptr : &found->second;
}

Window comparison_window(const Case& c, const CaseSensor& sensor) {
  const TimeWindow window = c.window_of(sensor);
  return {window.start_s, window.end_s};
}

ComparisonOptions comparison_options(const CaseSensor& sensor) {
  ComparisonOptions options;
  if (sensor.measured_is_band) options.band_widening = 0;
  return options;
}

}  // namespace sluice
