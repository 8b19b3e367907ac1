#include "solvers/counting_sort.h"

#include <gtest/gtest.h>

#include <vector>

namespace sluice {
namespace {

TEST(CountingSort, KeepsTheOrderWithinAKeyForAnyNumberOfThreads) {
  const std::vector<int> keys{2, 0, -1, 2, 0, 2, -1, 0};
  for (const int threads : {1, 2, 3, 16}) {
    std::vector<std::int32_t> start;
    std::vector<std::int32_t> order;
    counting_sort(
        1, 8, 3, threads, [&](std::int64_t i) { return keys[static_cast<std::size_t>(i)]; }, start, order);
    EXPECT_EQ(start, (std::vector<std::int32_t>{0, 3, 3, 5})) << threads;
    EXPECT_EQ(order, (std::vector<std::int32_t>{1, 4, 7, 3, 5})) << threads;
  }
}

TEST(CountingSort, OfNothingIsEmpty) {
  std::vector<std::int32_t> start;
  std::vector<std::int32_t> order{1};
  counting_sort(
      0, 4, 0, 2, [](std::int64_t) { return -1; }, start, order);
  EXPECT_EQ(start, std::vector<std::int32_t>{0});
  EXPECT_TRUE(order.empty());
}

}  // namespace
}  // namespace sluice
