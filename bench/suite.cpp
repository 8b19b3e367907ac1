#include "bench/suite.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace sluice::bench {
namespace {

void time_kernel(benchmark::State& state, const Kernel& kernel, int threads) {
  kernel.run();
  while (state.KeepRunning()) kernel.run();
  const auto calls = static_cast<double>(state.iterations());
  state.SetItemsProcessed(static_cast<std::int64_t>(kernel.work.items * calls));
  if (kernel.work.bytes > 0) state.SetBytesProcessed(static_cast<std::int64_t>(kernel.work.bytes * calls));
  state.counters["omp_threads"] = threads;
  if (kernel.work.operations <= 0) return;
  state.counters["flops_per_second"] = benchmark::Counter(kernel.work.operations * calls, benchmark::Counter::kIsRate);
  if (kernel.work.bytes > 0) state.counters["flops_per_byte"] = kernel.work.operations / kernel.work.bytes;
}

class TimedFunction final : public benchmark::internal::Benchmark {
 public:
  TimedFunction(const std::string& name, Timing timing)
      : benchmark::internal::Benchmark(name.c_str()), timing_(std::move(timing)) {}
  void Run(benchmark::State& state) override { timing_(state); }  // NOLINT(readability-identifier-naming)

 private:
  Timing timing_;
};

}  // namespace

std::string count_name(double count) {
  const int exponent = count > 0 ? static_cast<int>(std::floor(std::log10(count) + 1e-9)) : 0;
  return fmt::format("{:.3g}e{}", count / std::pow(10.0, exponent), exponent);
}

benchmark::internal::Benchmark* add_benchmark(const std::string& name, int threads, Timing timing) {
  // Google Benchmark keeps and deletes what it is given here.
  auto* const timed = new TimedFunction(fmt::format("{}/threads:{}", name, threads), std::move(timing));
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
  auto* const added = benchmark::internal::RegisterBenchmarkInternal(timed);
  return threads > 1 ? added->UseRealTime() : added;
}

void add_kernel(const std::string& name, const SuiteOptions& options, const MakeKernel& make) {
  for (const double particles : options.kernel_particles)
    for (const int threads : options.threads)
      add_benchmark(fmt::format("{}/{}", name, count_name(particles)), threads,
                    [=](benchmark::State& state) { time_kernel(state, make(particles, threads), threads); });
}

}  // namespace sluice::bench
