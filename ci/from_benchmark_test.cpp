#include "ci/from_benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// As Google Benchmark 1.7.1 writes it, with what is of no matter here left out.
const char* const file_text = R"({
  "context": { "date": "2026-11-25T14:31:44+01:00", "host_name": "h", "num_cpus": 2, "caches": [],
               "load_avg": [1.0, 2.0], "commit": "abc" },
  "benchmarks": [
    { "name": "wcsph/pair_sums/1000", "run_name": "wcsph/pair_sums/1000", "family_index": 0, "run_type": "iteration",
      "repetitions": 3, "repetition_index": 0, "threads": 1, "iterations": 10, "real_time": 65.0, "cpu_time": 64.0,
      "time_unit": "ms", "items_per_second": 1e4, "bytes_per_second": 8e4, "instructions": 1200 },
    { "name": "wcsph/pair_sums/1000", "run_name": "wcsph/pair_sums/1000", "run_type": "iteration",
      "repetition_index": 1, "threads": 1, "iterations": 10, "real_time": 5.0, "cpu_time": 4.0, "time_unit": "ms",
      "items_per_second": 2e5, "bytes_per_second": 8e4, "instructions": 1201 },
    { "name": "wcsph/pair_sums/1000", "run_name": "wcsph/pair_sums/1000", "run_type": "iteration",
      "repetition_index": 2, "threads": 1, "iterations": 10, "real_time": 6.0, "cpu_time": 5.0, "time_unit": "ms",
      "items_per_second": 1.9e5, "bytes_per_second": 8e4, "instructions": 1202, "omp_threads": 2.0e+00 },
    { "name": "other_median", "run_name": "other", "run_type": "aggregate", "aggregate_name": "median", "threads": 4,
      "iterations": 3, "real_time": 7.0, "cpu_time": 8.0, "time_unit": "us" },
    { "name": "other_cv", "run_name": "other", "run_type": "aggregate", "aggregate_name": "cv", "threads": 4,
      "iterations": 3, "real_time": 0.1, "cpu_time": 0.1, "time_unit": "us" },
    { "name": "broken", "run_name": "broken", "run_type": "iteration", "threads": 1, "error_occurred": true,
      "error_message": "no such kernel", "iterations": 1, "real_time": 0.0, "cpu_time": 0.0, "time_unit": "ns" },
    { "name": "mps/counted", "run_type": "iteration", "instructions": 77 }
  ]
})";

class FromBenchmarkTest : public testing::Test {
 protected:
  FromBenchmarkTest() { file = fs::path(testing::TempDir()) / "sluice-from-benchmark.json"; }
  ~FromBenchmarkTest() override { fs::remove(file); }

  std::vector<Result> results(const std::string& text, const Provenance& given = {.machine = "m"}) const {
    std::ofstream(file) << text;
    return results_of_benchmark(file, given);
  }
  std::string error(const std::string& text, const Provenance& given = {.machine = "m"}) const {
    try {
      results(text, given);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  static std::string without(std::string text, const std::string& part) {
    return text.replace(text.find(part), part.size(), "");
  }

  fs::path file;
};

TEST_F(FromBenchmarkTest, MediansOfRepetitionsInSi) {
  const auto all = results(file_text);
  const auto value = [&](const std::string& metric, const std::string& of) -> std::optional<double> {
    for (const Result& r : all)
      if (r.metric == metric && r.of == of) return r.value;
    ADD_FAILURE() << metric << " " << of;
    return std::nullopt;
  };
  EXPECT_DOUBLE_EQ(*value("time_per_iteration_s", "wcsph/pair_sums/1000"), 6e-3);
  EXPECT_DOUBLE_EQ(*value("cpu_time_per_iteration_s", "wcsph/pair_sums/1000"), 5e-3);
  EXPECT_DOUBLE_EQ(*value("items_per_second", "wcsph/pair_sums/1000"), 1.9e5);
  EXPECT_DOUBLE_EQ(*value("bytes_per_second", "wcsph/pair_sums/1000"), 8e4);
  EXPECT_DOUBLE_EQ(*value("instructions", "wcsph/pair_sums/1000"), 1201);
  EXPECT_DOUBLE_EQ(*value("time_per_iteration_s", "other"), 7e-6);
  EXPECT_DOUBLE_EQ(*value("instructions", "mps/counted"), 77);
  EXPECT_FALSE(value("time_per_iteration_s", "broken"));
  EXPECT_EQ(all.size(), 5u + 2u + 1u + 1u);
}

TEST_F(FromBenchmarkTest, Provenance) {
  const auto all = results(file_text);
  EXPECT_EQ(all.front().date, "2026-11-25T13:31:44Z");
  EXPECT_EQ(all.front().commit, "abc");
  EXPECT_EQ(all.front().machine, "m");
  EXPECT_EQ(all.front().case_name, "benchmark");
  EXPECT_EQ(all.front().solver, "wcsph");
  EXPECT_EQ(all.front().threads, 2);
  EXPECT_EQ(all.back().solver, "mps");
  EXPECT_EQ(all.back().run, all.front().run);
  EXPECT_EQ(results(file_text, {.commit = "def", .machine = "m"}).front().commit, "def");
}

TEST_F(FromBenchmarkTest, ErrorsNameFileAndKey) {
  EXPECT_THAT(error(file_text, {}),
              HasSubstr("sluice-from-benchmark.json: context.machine: is missing (give --machine"));
  EXPECT_THAT(error(without(file_text, ", \"commit\": \"abc\"")), HasSubstr("context.commit: is missing"));
  EXPECT_THAT(error(without(file_text, "2026-")), HasSubstr("is not a date (give --date)"));
  EXPECT_THAT(error("name,real_time\n"), HasSubstr("--benchmark_out_format=json"));
  EXPECT_THAT(error("{}"), HasSubstr("no `context` and `benchmarks`"));
  EXPECT_THAT(error(R"({"context": {"date": "2026-11-25T13:31:44Z", "commit": "a"}, "benchmarks": [{"name": 1}]})"),
              HasSubstr("wrong type"));
  EXPECT_THROW(results_of_benchmark("no/such.json"), std::runtime_error);
}

}  // namespace
}  // namespace sluice::ci
