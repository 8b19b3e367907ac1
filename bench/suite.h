// The benchmarks of one program: what its command line chooses, and how a kernel becomes a benchmark.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace sluice::bench {

struct SuiteOptions {
  std::vector<double> kernel_particles{1e5};
  std::vector<double> step_particles{1e5, 5e5, 2e6};
  std::vector<int> threads;
  double machine_array_bytes = 64e6;  ///< each of three; together several times the last cache
};

/// What one call of a kernel does. Bytes are those of the arrays that it must read or write at least once, each counted
/// once for every pass over it, however often caches serve it; operations are those of pairs within reach.
struct Work {
  double items = 0;
  double bytes = 0;
  double operations = 0;  ///< floating-point; zero: not counted
};

struct Kernel {
  std::function<void()> run;
  Work work;
};

/// Prepared when the benchmark runs, for a number of particles and of threads.
using MakeKernel = std::function<Kernel(double particles, int threads)>;

/// Registers `name/1e5/threads:1` for every size and number of threads. Counters: items_per_second, bytes_per_second,
/// and where operations are counted flops_per_second and flops_per_byte; `omp_threads` beside them.
void add_kernel(const std::string& name, const SuiteOptions& options, const MakeKernel& make);

using Timing = std::function<void(benchmark::State&)>;

/// Registers a benchmark. One thread is timed by its processor time, which other programs on the machine hardly
/// disturb; several by the clock.
benchmark::internal::Benchmark* add_benchmark(const std::string& name, int threads, Timing timing);

/// "1e5" or "2.5e5", for names.
std::string count_name(double count);

void add_machine_benchmarks(const SuiteOptions& options);
void add_wcsph_kernels(const SuiteOptions& options);
void add_mps_kernels(const SuiteOptions& options);
void add_whole_steps(const SuiteOptions& options);

}  // namespace sluice::bench
