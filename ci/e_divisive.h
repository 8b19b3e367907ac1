// Change points by energy statistics: E-divisive, D. S. Matteson and N. A. James, "A nonparametric approach for
// multiple change point analysis of multivariate data", J. Am. Stat. Assoc. 109 (2014) 334-345, for one variable and
// alpha = 1.
//
// Two samples X (m values) and Y (l values) differ by
//   E(X, Y) = 2/(m l) sum |x - y| - 2/(m (m-1)) sum_{pairs} |x - x'| - 2/(l (l-1)) sum_{pairs} |y - y'|,
//   Q(X, Y) = m l / (m + l) E(X, Y).
// A segment is divided where Q of what lies before a point against what lies between it and some later point is
// greatest; of all segments the one with the greatest Q is divided first. The division stands when values shuffled
// within their segments seldom give as much. The shuffles come from a fixed seed, so that the answer is a function of
// the values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sluice::ci {

struct EDivisiveOptions {
  std::size_t shortest_segment = 3;
  double significance = 0.01;
  int permutations = 199;
  std::uint32_t seed = 20140101;
};

/// A change point: `first` is the index of the first value of the new segment.
struct Division {
  std::size_t first = 0;
  double statistic = 0;  ///< Q
  double p_value = 1;    ///< (1 + shuffles that reach Q) / (1 + shuffles)
};

/// Q of two samples of at least one value each; a sample of one value has no inner distance.
double energy_statistic(std::span<const double> x, std::span<const double> y);

/// Significant change points, by position. Values must be finite. Cost: O(n^2) a division and shuffle; a test ends as
/// soon as its outcome is certain.
std::vector<Division> e_divisive(std::span<const double> values, const EDivisiveOptions& options = {});

/// Every place that e_divisive() could name, by position: the same recursion without the test. Cheap: O(n^2) in all.
std::vector<std::size_t> possible_divisions(std::span<const double> values, std::size_t shortest_segment);

}  // namespace sluice::ci
