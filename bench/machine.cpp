// The machine's own peaks, as far as portable C++ reaches them: fused multiply-adds on vectors held in registers, and
// the triad a = b + s c of STREAM over arrays that no cache holds. The roofs of the roofline figure.
#include <benchmark/benchmark.h>

#include <array>
#include <experimental/simd>
#include <memory>
#include <vector>

#include "bench/suite.h"

namespace sluice::bench {
namespace {

namespace stdx = std::experimental;

/// Independent chains, enough to hide the latency of two units.
constexpr std::size_t chains = 16;
constexpr int rounds = 20000;

/// Multiplications and additions of all chains, one after the other. The result is handed back so that it is computed.
template <class Real>
[[gnu::noinline]] Real multiply_add(Real factor, Real summand) {
  using Pack = stdx::native_simd<Real>;
  std::array<Pack, chains> chain;
  for (std::size_t k = 0; k < chains; ++k) chain[k] = Pack(static_cast<Real>(k));
  const Pack f(factor);
  const Pack s(summand);
  for (int round = 0; round < rounds; ++round)
    for (Pack& c : chain) c = c * f + s;
  Pack sum{};
  for (const Pack& c : chain) sum += c;
  return stdx::reduce(sum);
}

template <class Real>
void time_multiply_add(benchmark::State& state, int threads) {
  Real factor = static_cast<Real>(0.999);
  benchmark::DoNotOptimize(factor);
  while (state.KeepRunning()) {
    Real sum{};
#pragma omp parallel for num_threads(threads) schedule(static, 1) reduction(+ : sum)
    for (int t = 0; t < threads; ++t) sum += multiply_add(factor, static_cast<Real>(0.001));
    benchmark::DoNotOptimize(sum);
  }
  const double a_call = 2.0 * chains * rounds * stdx::native_simd<Real>::size() * threads;
  state.counters["omp_threads"] = threads;
  state.counters["lanes"] = stdx::native_simd<Real>::size();
  state.SetItemsProcessed(static_cast<std::int64_t>(a_call / 2 * static_cast<double>(state.iterations())));
  state.counters["flops_per_second"] =
      benchmark::Counter(a_call * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// Arrays that each thread touches first where it will use them.
struct TriadArrays {
  TriadArrays(std::size_t n, int threads)
      : a(std::make_unique_for_overwrite<double[]>(n)),
        b(std::make_unique_for_overwrite<double[]>(n)),
        c(std::make_unique_for_overwrite<double[]>(n)) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = 0;
      b[i] = 1;
      c[i] = 2;
    }
  }
  std::unique_ptr<double[]> a, b, c;
};

void time_triad(benchmark::State& state, double array_bytes, int threads) {
  const auto n = static_cast<std::size_t>(array_bytes / sizeof(double));
  const TriadArrays arrays(n, threads);
  double s = 3;
  benchmark::DoNotOptimize(s);
  while (state.KeepRunning()) {
    double* const a = arrays.a.get();
    const double* const b = arrays.b.get();
    const double* const c = arrays.c.get();
#pragma omp parallel for simd num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    benchmark::ClobberMemory();
  }
  const auto elements = static_cast<std::int64_t>(n) * state.iterations();
  state.counters["omp_threads"] = threads;
  state.SetItemsProcessed(elements);
  // As STREAM counts: two arrays read, one written, and not the reading of what is to be overwritten.
  state.SetBytesProcessed(elements * static_cast<std::int64_t>(3 * sizeof(double)));
}

}  // namespace

void add_machine_benchmarks(const SuiteOptions& options) {
  const double bytes = options.machine_array_bytes;
  for (const int threads : options.threads) {
    add_benchmark("machine/multiply_add_float", threads,
                  [=](benchmark::State& state) { time_multiply_add<float>(state, threads); });
    add_benchmark("machine/multiply_add_double", threads,
                  [=](benchmark::State& state) { time_multiply_add<double>(state, threads); });
    add_benchmark("machine/triad", threads, [=](benchmark::State& state) { time_triad(state, bytes, threads); });
  }
}

}  // namespace sluice::bench
