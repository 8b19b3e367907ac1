#include "bench/suite.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>

namespace sluice::bench {
namespace {

void time_kernel(benchmark::State& state, const Kernel& kernel, int threads) {
  kernel.run();
  for (auto _ : state) kernel.run();
  const auto calls = static_cast<double>(state.iterations());
  state.SetItemsProcessed(static_cast<std::int64_t>(kernel.work.items * calls));
  if (kernel.work.bytes > 0) state.SetBytesProcessed(static_cast<std::int64_t>(kernel.work.bytes * calls));
  state.counters["omp_threads"] = threads;
  if (kernel.work.operations <= 0) return;
  state.counters["flops_per_second"] = benchmark::Counter(kernel.work.operations * calls, benchmark::Counter::kIsRate);
  if (kernel.work.bytes > 0) state.counters["flops_per_byte"] = kernel.work.operations / kernel.work.bytes;
}

}  // namespace

std::string count_name(double count) {
  const int exponent = count > 0 ? static_cast<int>(std::floor(std::log10(count) + 1e-9)) : 0;
  return fmt::format("{:.3g}e{}", count / std::pow(10.0, exponent), exponent);
}

void time_by_threads(benchmark::internal::Benchmark* added, int threads) {
  if (threads > 1) added->UseRealTime();
}

void add_kernel(const std::string& name, const SuiteOptions& options, const MakeKernel& make) {
  for (const double particles : options.kernel_particles)
    for (const int threads : options.threads) {
      const std::string full = fmt::format("{}/{}/threads:{}", name, count_name(particles), threads);
      time_by_threads(
          benchmark::RegisterBenchmark(
              full.c_str(), [=](benchmark::State& state) { time_kernel(state, make(particles, threads), threads); }),
          threads);
    }
}

}  // namespace sluice::bench
