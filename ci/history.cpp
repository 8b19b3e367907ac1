#include "ci/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "validation/file_hash.h"

namespace sluice::ci {

bool SeriesKey::operator<(const SeriesKey& other) const {
  const auto fields = [](const SeriesKey& k) {
    return std::tie(k.case_name, k.solver, k.parameters, k.metric, k.of, k.machine);
  };
  return fields(*this) < fields(other);
}

std::string SeriesKey::id() const {
  std::string text;
  for (const std::string* part : {&case_name, &solver, &parameters, &metric, &of, &machine}) text += *part + '\n';
  return fmt::format("{:016x}", fnv1a64(text)).substr(0, 8);
}

std::string SeriesKey::quantity() const {
  return of.empty() ? metric : fmt::format("{} of {}", metric, of);
}

std::string SeriesKey::run_kind() const {
  std::string text = solver.empty() ? case_name : case_name + " " + solver;
  const auto values = nlohmann::json::parse(parameters, nullptr, false);
  if (!values.is_object()) return text;
  for (const auto& [name, value] : values.items()) {
    const std::string written = value.is_string() ? value.get<std::string>() : value.dump();
    text += fmt::format(", {} {}", name, value.is_number() ? fmt::format("{:g}", value.get<double>()) : written);
  }
  return text;
}

SeriesKey key_of(const Result& result) {
  SeriesKey key{result.case_name, result.solver, result.parameters.dump(), result.metric, result.of, ""};
  if (kind_of(result.metric).same_machine)
    key.machine = result.threads > 0 ? fmt::format("{}, {} threads", result.machine, result.threads) : result.machine;
  return key;
}

std::vector<MetricSeries> series_of(const Ledger& ledger) {
  std::map<SeriesKey, MetricSeries> by_key;
  for (const Result& result : ledger.results) {
    SeriesKey key = key_of(result);
    MetricSeries& series = by_key[key];
    series.key = std::move(key);
    series.unit = result.unit;
    series.points.push_back(&result);
  }
  std::vector<MetricSeries> all;
  for (auto& [key, series] : by_key) {
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const Result* a, const Result* b) { return a->date < b->date; });
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace sluice::ci
