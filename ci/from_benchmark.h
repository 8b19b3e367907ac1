// Results for the ledger from a file that Google Benchmark wrote (--benchmark_out=FILE --benchmark_out_format=json).
#pragma once

#include <filesystem>
#include <vector>

#include "ci/from_run.h"
#include "ci/ledger.h"

namespace sluice::ci {

/// Times become seconds an iteration; items, bytes and other counters keep their names, but `omp_threads`, which is the
/// number of threads. Of repetitions the median counts. A benchmark's solver is the part of its name before the first
/// "/" if that is the name of one ("mps/v_cycle/100000"). Commit, machine, compiler and flags come from `given`, or
/// from the file's context (--benchmark_context=commit=..). A benchmark that reported an error is a result without a
/// value. Throws std::runtime_error naming the file and the key: not such a file, commit or machine not stated.
std::vector<Result> results_of_benchmark(const std::filesystem::path& file, const Provenance& given = {});

}  // namespace sluice::ci
