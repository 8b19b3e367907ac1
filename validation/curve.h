// Walking along linear interpolants: what the metrics have in common.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "validation/metrics.h"

namespace sluice {

/// The integral of a curve's interpolant from its first sample, for any number of windows in any order.
class CumulativeIntegral {
 public:
  explicit CumulativeIntegral(const Curve& curve);
  /// Times outside the samples are taken as the first or the last one.
  double between(double begin_s, double end_s) const { return upto(end_s) - upto(begin_s); }

 private:
  double upto(double t_s) const;

  Curve curve_;
  std::vector<double> at_sample_;
};

/// The part of the window in which the curve has samples (empty: end before begin).
Window clipped(const Curve& curve, Window window);

/// The window's ends and every sample time of the curves between them, sorted, each once.
std::vector<double> merged_times(std::initializer_list<Curve> curves, Window window);

/// The curve's interpolant at sorted times, all within its samples.
std::vector<double> values_at(const Curve& curve, const std::vector<double>& times_s);

/// First index with time >= t_s.
std::size_t first_at_or_after(const Curve& curve, double t_s);

/// Largest sample with time in the window; missing when there is none. Says nothing of coverage.
std::optional<Peak> largest_sample(const Curve& curve, Window window);

/// A series' bins: the edges of bin k, and whether they reach both ends of a window.
Window bin(const MeasuredSeries& series, std::size_t k);
bool covers(const MeasuredSeries& series, Window window);

/// Length of what two windows share [s]; 0 when nothing.
double shared_s(Window a, Window b);

/// Share, 0..1, of a straight piece in which both of two linear functions, given at its ends, are not negative.
double share_not_negative(double a_begin, double a_end, double b_begin, double b_end);

}  // namespace sluice
