#include "ci/e_divisive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace sluice::ci {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The best place to divide a segment; `statistic` is zero when it cannot be divided.
struct Split {
  std::size_t first = 0;  ///< from the segment's begin
  double statistic = 0;
};

/// Finds splits, keeping its memory from one to the next.
class Splitter {
 public:
  explicit Splitter(std::size_t shortest) : shortest_(std::max<std::size_t>(shortest, 1)) {}

  /// Ends early once a statistic of at least `enough` is found.
  Split best(std::span<const double> x, double enough = never) {
    Split split;
    const std::size_t n = x.size();
    if (n < 2 * shortest_) return split;
    sum_distances(x);
    for (std::size_t first = shortest_; first + shortest_ <= n && split.statistic < enough; ++first)
      improve(split, first, n);
    return split;
  }

 private:
  /// sums_(i, j) = sum of |x[a] - x[b]| over a < i, b < j, for i <= j.
  void sum_distances(std::span<const double> x) {
    stride_ = x.size() + 1;
    while (inverse_.size() < stride_) inverse_.push_back(1 / static_cast<double>(inverse_.size()));
    sums_.assign(stride_ * stride_, 0.0);
    column_.assign(x.size(), 0.0);
    for (std::size_t i = 1; i <= x.size(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < x.size(); ++j) {
        column_[j] += std::abs(x[i - 1] - x[j]);
        sum += column_[j];
        sums_[i * stride_ + j + 1] = sum;
      }
    }
  }

  /// The definition times m l / (m + l), with inverses from a table in the place of divisions.
  void improve(Split& split, std::size_t first, std::size_t size) const {
    const double* row = &sums_[first * stride_];
    const auto m = static_cast<double>(first);
    const double before = row[first];
    const double before_per_pair = before * inverse_[first - 1];
    for (std::size_t end = first + shortest_; end <= size; ++end) {
      const std::size_t length = end - first;
      const double between = row[end] - before;
      const double after_per_pair = (sums_[end * stride_ + end] - 2 * between - before) * inverse_[length - 1];
      const double q =
          (2 * between - static_cast<double>(length) * before_per_pair - m * after_per_pair) * inverse_[end];
      if (q > split.statistic) split = {first, q};
    }
  }

  std::size_t shortest_;
  std::size_t stride_ = 0;
  std::vector<double> sums_;
  std::vector<double> column_;
  std::vector<double> inverse_{0};  ///< 1 / k; 0 for a sample of one, which has no inner distance
};

struct Segment {
  std::size_t begin = 0;
  std::size_t end = 0;
  Split split;  ///< its best

  std::size_t length() const { return end - begin; }
};

std::vector<Segment>::iterator most_divisible(std::vector<Segment>& segments) {
  return std::max_element(segments.begin(), segments.end(),
                          [](const Segment& a, const Segment& b) { return a.split.statistic < b.split.statistic; });
}

void shuffle(std::span<double> values, std::mt19937& random) {
  for (std::size_t i = values.size(); i > 1; --i) {
    // std::uniform_int_distribution may differ between libraries; this does not.
    const auto j = static_cast<std::size_t>((std::uint64_t{random()} * i) >> 32);
    std::swap(values[i - 1], values[j]);
  }
}

/// The p-value of a greatest statistic among segments; above `significance` it is only a lower estimate.
double p_value(std::span<const double> values, const std::vector<Segment>& segments, double statistic,
               const EDivisiveOptions& options, Splitter& splitter) {
  // Rounding must not tell a shuffle that brings back the same arrangement from the original.
  const double reached = statistic * (1 - 1e-12);
  const double all = options.permutations + 1.0;
  std::vector<double> shuffled(values.begin(), values.end());
  std::mt19937 random(options.seed);
  int as_much = 0;
  for (int k = 0; k < options.permutations && (1 + as_much) / all <= options.significance; ++k) {
    bool reaches = false;
    for (const Segment& segment : segments) {
      const auto part = std::span(shuffled).subspan(segment.begin, segment.length());
      shuffle(part, random);
      reaches = reaches || splitter.best(part, reached).statistic >= reached;
    }
    as_much += reaches;
  }
  return (1 + as_much) / all;
}

}  // namespace

double energy_statistic(std::span<const double> x, std::span<const double> y) {
  const auto mean_distance = [](std::span<const double> a, std::span<const double> b, double pairs) {
    double sum = 0;
    for (const double u : a)
      for (const double v : b) sum += std::abs(u - v);
    return pairs > 0 ? sum / pairs : 0;
  };
  const auto m = static_cast<double>(x.size()), l = static_cast<double>(y.size());
  return m * l / (m + l) *
         (2 * mean_distance(x, y, m * l) - mean_distance(x, x, m * (m - 1)) - mean_distance(y, y, l * (l - 1)));
}

std::vector<Division> e_divisive(std::span<const double> values, const EDivisiveOptions& options) {
  Splitter splitter(options.shortest_segment);
  std::vector<Segment> segments{{0, values.size(), splitter.best(values)}};
  std::vector<Division> divisions;
  while (true) {
    const auto divided = most_divisible(segments);
    const Split split = divided->split;
    if (split.statistic <= 0) break;
    const double p = p_value(values, segments, split.statistic, options, splitter);
    if (p > options.significance) break;
    const Segment whole = *divided;
    const std::size_t middle = whole.begin + split.first;
    divisions.push_back({middle, split.statistic, p});
    *divided = {whole.begin, middle, splitter.best(values.subspan(whole.begin, split.first))};
    segments.push_back({middle, whole.end, splitter.best(values.subspan(middle, whole.end - middle))});
  }
  std::sort(divisions.begin(), divisions.end(), [](const Division& a, const Division& b) { return a.first < b.first; });
  return divisions;
}

std::vector<std::size_t> possible_divisions(std::span<const double> values, std::size_t shortest_segment) {
  Splitter splitter(shortest_segment);
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, values.size()}};
  std::vector<std::size_t> places;
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    const Split split = splitter.best(values.subspan(begin, end - begin));
    if (split.statistic <= 0) continue;
    places.push_back(begin + split.first);
    open.emplace_back(begin, begin + split.first);
    open.emplace_back(begin + split.first, end);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace sluice::ci
