// All benchmarks in one program. Options of its own come beside those of Google Benchmark (--benchmark_filter,
// --benchmark_out, ...); README.md tells which are of use.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/prepared_run.h"
#include "bench/suite.h"

namespace {

/// 1, 2, 4, ... and as many as there are processors.
std::vector<int> thread_numbers() {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> numbers;
  for (int n = 1; n < processors; n *= 2) numbers.push_back(n);
  numbers.push_back(processors);
  return numbers;
}

/// `arguments` are the program's name and the options that it has not taken itself. They must stay: Google Benchmark
/// keeps the name by its address.
void initialise_google_benchmark(std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  auto argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  benchmark::Initialize(&argc, argv.data());
  if (argc > 1) throw std::runtime_error(fmt::format("unknown option `{}` (--help lists them)", argv[1]));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times the kernels and the whole steps of both solvers, and the machine's own peaks"};
  app.allow_extras()->footer(
      "Options of Google Benchmark are taken too: --benchmark_filter=wcsph/fluid_pairs, --benchmark_list_tests,\n"
      "--benchmark_out=FILE --benchmark_out_format=json, --benchmark_repetitions=N, --benchmark_min_time=SECONDS");
  sluice::bench::SuiteOptions options;
  options.threads = thread_numbers();
  app.add_option("--particles", options.kernel_particles, "Fluid particles of the kernels")
      ->check(CLI::Range(5e3, 1e8))
      ->capture_default_str();
  app.add_option("--step-particles", options.step_particles, "Fluid particles of the whole steps")
      ->check(CLI::Range(5e3, 1e8))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Numbers of threads (default: 1, 2, 4, ... processors)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--array-bytes", options.machine_array_bytes, "Length of each array of the triad")
      ->check(CLI::Range(1e3, 1e11))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::vector<std::string> arguments;
  try {
    arguments = app.remaining();
    arguments.insert(arguments.begin(), argv[0]);
    initialise_google_benchmark(arguments);
    for (const auto& [key, value] : sluice::bench::provenance()) benchmark::AddCustomContext(key, value);
    sluice::bench::add_machine_benchmarks(options);
    sluice::bench::add_wcsph_kernels(options);
    sluice::bench::add_mps_kernels(options);
    sluice::bench::add_whole_steps(options);
    if (benchmark::RunSpecifiedBenchmarks() == 0)
      throw std::runtime_error("no benchmark has such a name (--benchmark_list_tests lists them)");
  } catch (const std::exception& error) {
    fmt::print(stderr, "sluice_bench: error: {}\n", error.what());
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
