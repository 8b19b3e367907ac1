#include "ci/from_benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <map>
#include <string>

#include "ci/shifts.h"
#include "validation/file_error.h"
#include "validation/file_hash.h"
#include "validation/solver_factory.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read(const fs::path& file) {
  std::ifstream in(file);
  if (!in) fail(file, "cannot be read");
  json content = json::parse(in, nullptr, false);
  if (content.is_discarded()) fail(file, "is not JSON (write it with --benchmark_out_format=json)");
  if (!content.is_object() || !content.contains("context") || !content.contains("benchmarks") ||
      !content["context"].is_object() || !content["benchmarks"].is_array())
    fail(file, "has no `context` and `benchmarks` (write it with --benchmark_out_format=json)");
  return content;
}

/// Google Benchmark writes local time with its offset, "2026-11-25T14:31:44+01:00".
std::string utc(const fs::path& file, const std::string& local) {
  if (is_date(local)) return local;
  std::tm parts{};
  const char* rest = strptime(local.c_str(), "%Y-%m-%dT%H:%M:%S%z", &parts);
  if (rest == nullptr || *rest != '\0')
    fail(file, fmt::format("context.date: `{}` is not a date (give --date)", local));
  const long offset_s = parts.tm_gmtoff;  // timegm() clears it
  const std::time_t seconds = timegm(&parts) - offset_s;
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Result common_of(const fs::path& file, const json& context, const Provenance& given) {
  const auto stated = [&](const char* key, const std::string& known) {
    if (!known.empty()) return known;
    const auto found = context.find(key);
    return found != context.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto needed = [&](const char* key, const std::string& known) {
    std::string value = stated(key, known);
    if (value.empty())
      fail(file,
           fmt::format("context.{0}: is missing (give --{0}, or run the benchmark with --benchmark_context={0}=..)",
                       key));
    return value;
  };
  Result common;
  common.date = utc(file, needed("date", given.date));
  common.commit = needed("commit", given.commit);
  common.machine = needed("machine", given.machine);
  common.compiler = stated("compiler", given.compiler);
  common.flags = stated("flags", given.flags);
  common.case_name = benchmark_case;
  common.run = file_hash(file);
  common.run.erase(0, common.run.find(':') + 1);
  common.link = given.link.empty() ? file.lexically_normal().generic_string() : given.link;
  return common;
}

std::string solver_of(const std::string& name) {
  const std::string first = name.substr(0, name.find('/'));
  const auto& solvers = solver_names();
  return std::find(solvers.begin(), solvers.end(), first) == solvers.end() ? "" : first;
}

double seconds_of(const fs::path& file, const std::string& unit) {
  if (unit == "ns") return 1e-9;
  if (unit == "us") return 1e-6;
  if (unit == "ms") return 1e-3;
  if (unit == "s") return 1;
  fail(file, fmt::format("time_unit: unknown unit `{}`", unit));
}

/// Numbers of an entry that are no measurements.
bool is_bookkeeping(const std::string& key) {
  static constexpr std::array<std::string_view, 9> keys{"family_index", "per_family_instance_index",
                                                        "repetitions",  "repetition_index",
                                                        "threads",      "iterations",
                                                        "real_time",    "cpu_time",
                                                        "omp_threads"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::string unit_of_counter(const std::string& name) {
  if (name == "bytes_per_second") return "B/s";
  return name.ends_with("_per_second") ? "1/s" : "1";
}

/// One benchmark with its repetitions.
struct Benchmark {
  std::string name;
  int threads = 0;
  std::string error;
  std::map<std::string, std::vector<double>> repetitions;  ///< by metric
  std::map<std::string, double> medians;                   ///< as the file has them
};

std::map<std::string, double> values_of(const fs::path& file, const json& entry) {
  std::map<std::string, double> values;
  for (const auto& [key, value] : entry.items())
    if (value.is_number() && !is_bookkeeping(key)) values[key] = value.get<double>();
  const double unit_s = seconds_of(file, entry.value("time_unit", "ns"));
  if (entry.contains("real_time")) values["time_per_iteration_s"] = unit_s * entry.at("real_time").get<double>();
  if (entry.contains("cpu_time")) values["cpu_time_per_iteration_s"] = unit_s * entry.at("cpu_time").get<double>();
  return values;
}

void take(const fs::path& file, const json& entry, Benchmark& benchmark) {
  // Google's own count is of its threads, of which there is one; the programs here state those that they use.
  benchmark.threads = entry.value("omp_threads", entry.value("threads", 0));
  if (entry.value("error_occurred", false)) {
    benchmark.error = entry.value("error_message", "the benchmark reported an error");
  } else if (entry.value("run_type", "iteration") == "iteration") {
    for (const auto& [metric, value] : values_of(file, entry)) benchmark.repetitions[metric].push_back(value);
  } else if (entry.value("aggregate_name", "") == "median") {
    benchmark.medians = values_of(file, entry);
  }
}

std::vector<Benchmark> benchmarks_of(const fs::path& file, const json& entries) {
  std::vector<Benchmark> benchmarks;
  for (const json& entry : entries) {
    if (!entry.is_object() || !entry.contains("name")) fail(file, "benchmarks: an entry has no name");
    const std::string name = entry.value("run_name", entry.at("name").get<std::string>());
    auto found = std::find_if(benchmarks.begin(), benchmarks.end(), [&](const Benchmark& b) { return b.name == name; });
    if (found == benchmarks.end()) {
      benchmarks.emplace_back().name = name;
      found = benchmarks.end() - 1;
    }
    take(file, entry, *found);
  }
  return benchmarks;
}

std::string unit_of(const std::string& metric) {
  return metric.ends_with("_iteration_s") ? "s" : unit_of_counter(metric);
}

void add_results(const Benchmark& benchmark, Result common, std::vector<Result>& results) {
  common.of = benchmark.name;
  common.solver = solver_of(benchmark.name);
  common.threads = benchmark.threads;
  const auto add = [&](const std::string& metric, std::optional<double> value) {
    Result& result = results.emplace_back(common);
    result.metric = metric;
    result.value = value;
    result.unit = unit_of(metric);
    if (!value) result.reason = benchmark.error;
  };
  if (!benchmark.error.empty()) {
    add("time_per_iteration_s", std::nullopt);
    return;
  }
  std::map<std::string, double> values = benchmark.medians;
  if (values.empty())
    for (const auto& [metric, repetitions] : benchmark.repetitions) values[metric] = median(repetitions);
  for (const auto& [metric, value] : values) add(metric, value);
}

}  // namespace

std::vector<Result> results_of_benchmark(const fs::path& file, const Provenance& given) {
  const json content = read(file);
  const Result common = common_of(file, content["context"], given);
  std::vector<Result> results;
  try {
    for (const Benchmark& benchmark : benchmarks_of(file, content["benchmarks"]))
      add_results(benchmark, common, results);
  } catch (const json::exception& error) {
    fail(file, fmt::format("benchmarks: a value has the wrong type: {}", error.what()));
  }
  return results;
}

}  // namespace sluice::ci
