// A stable sort of many by few keys, by several threads; its result does not depend on how many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sluice {

/// Sorts the numbers first .. last - 1 by key(i), which is 0 .. keys - 1, or negative where i is left out. Key k then
/// has order[start[k]] .. order[start[k + 1] - 1], which ascend. Every block of numbers counts, then knows where each
/// of its keys begins, then places.
template <class Key>
void counting_sort(std::int64_t first, std::int64_t last, std::size_t keys, int threads, Key&& key,
                   std::vector<std::int32_t>& start, std::vector<std::int32_t>& order) {
  const std::int64_t n = last - first;
  // As many as pay: each has a count of every key.
  const std::int64_t blocks =
      std::clamp<std::int64_t>(n / std::max<std::int64_t>(1, static_cast<std::int64_t>(keys)), 1, threads);
  std::vector<std::int32_t> counts(keys * static_cast<std::size_t>(blocks), 0);
  const auto for_block = [&](std::int64_t b, auto&& visit) {
    for (std::int64_t i = first + n * b / blocks; i < first + n * (b + 1) / blocks; ++i)
      if (const std::int64_t k = key(i); k >= 0) visit(i, static_cast<std::size_t>(k));
  };
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) {
    std::int32_t* count = counts.data() + static_cast<std::size_t>(b) * keys;
    for_block(b, [&](std::int64_t, std::size_t k) { ++count[k]; });
  }
  start.resize(keys + 1);
  std::int32_t total = 0;
  for (std::size_t k = 0; k < keys; ++k) {
    start[k] = total;
    for (std::int64_t b = 0; b < blocks; ++b) {
      std::int32_t& c = counts[static_cast<std::size_t>(b) * keys + k];
      total += std::exchange(c, total);
    }
  }
  start[keys] = total;
  order.resize(static_cast<std::size_t>(total));
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) {
    std::int32_t* next = counts.data() + static_cast<std::size_t>(b) * keys;
    for_block(b, [&](std::int64_t i, std::size_t k) {
      order[static_cast<std::size_t>(next[k]++)] = static_cast<std::int32_t>(i);
    });
  }
}

}  // namespace sluice
