#include "ci/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "validation/file_hash.h"

namespace sluice::ci {
namespace {

using KindOfRun = std::tuple<std::string, std::string, std::string>;  // case, solver, parameters
KindOfRun kind_of_run(const SeriesKey& key) {
  return {key.case_name, key.solver, key.parameters};
}

/// One result of every run of a kind, by date and the run's name.
using RunsOfAKind = std::map<std::pair<std::string, std::string>, const Result*>;

/// Whether a metric is what every run gives that comes to its end.
bool is_owed(const std::string& metric) {
  return kind_of(metric).family == Family::accuracy && metric != "finished";
}

/// Another code's sensor may be gone from its files, and a metric from our program: nothing is written of it then.
void add_absent(MetricSeries& series, const RunsOfAKind& runs) {
  std::set<std::pair<std::string, std::string>> present;
  for (const Result* point : series.points) present.emplace(point->date, point->run);
  for (auto at = runs.upper_bound(*present.begin()); at != runs.end(); ++at) {
    if (present.contains(at->first)) continue;
    auto absent = std::make_shared<Result>(*at->second);
    absent->metric = series.key.metric;
    absent->of = series.key.of;
    absent->unit = series.unit;
    absent->value.reset();
    absent->reason = "the run gives no such value any more";
    series.points.push_back(absent.get());
    series.absent.push_back(std::move(absent));
  }
}

}  // namespace

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
  std::map<KindOfRun, RunsOfAKind> runs;
  for (const Result& result : ledger.results) {
    SeriesKey key = key_of(result);
    if (is_owed(key.metric)) runs[kind_of_run(key)].emplace(std::pair(result.date, result.run), &result);
    MetricSeries& series = by_key[key];
    series.key = std::move(key);
    series.unit = result.unit;
    series.points.push_back(&result);
  }
  std::vector<MetricSeries> all;
  for (auto& [key, series] : by_key) {
    if (is_owed(key.metric)) add_absent(series, runs.at(kind_of_run(key)));
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const Result* a, const Result* b) { return a->date < b->date; });
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace sluice::ci
