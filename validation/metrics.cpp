#include "validation/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/curve.h"

namespace sluice {

namespace {

/// The median of the intervals within the window [s]; 0 when there is none.
double usual_interval_s(const Curve& curve, Window window) {
  std::vector<double> intervals_s;
  for (auto i = std::max<std::size_t>(1, first_at_or_after(curve, window.begin_s)); i < curve.t_s.size(); ++i) {
    if (curve.t_s[i - 1] >= window.end_s) break;
    intervals_s.push_back(curve.t_s[i] - curve.t_s[i - 1]);
  }
  if (intervals_s.empty()) return 0;
  const auto middle = intervals_s.begin() + static_cast<std::ptrdiff_t>((intervals_s.size() - 1) / 2);
  std::nth_element(intervals_s.begin(), middle, intervals_s.end());
  return *middle;
}

/// One interval is what a recording may lack at an end: that beside the end or, since codes that choose their time
/// steps may happen to have a short one there, the usual one. The little more is for rounding of the stamps.
bool is_one_interval(double missing_s, double interval_s, const Curve& curve, Window window) {
  constexpr double share = 0.1;
  constexpr double rounding = 1.000001;
  if (missing_s > share * (window.end_s - window.begin_s)) return false;
  return missing_s <= rounding * interval_s || missing_s <= rounding * usual_interval_s(curve, window);
}

bool reaches_begin(const Curve& curve, Window window) {
  return curve.t_s.size() >= 2 && curve.t_s.front() < window.end_s &&
         is_one_interval(curve.t_s.front() - window.begin_s, curve.t_s[1] - curve.t_s[0], curve, window);
}

/// Over anything longer a straight line would be an invention.
double shortest_gap_s(Window window) {
  return 0.01 * (window.end_s - window.begin_s);
}

/// Whether rows are missing between samples i - 1 and i: far longer than the intervals beside it. Codes that write few
/// rows in calm water and many at an impact have long intervals beside long ones.
bool is_gap(const Curve& curve, std::size_t i, double shortest_s) {
  constexpr double times_its_neighbours = 20;
  const double before_s = i >= 2 ? curve.t_s[i - 1] - curve.t_s[i - 2] : 0;
  const double after_s = i + 1 < curve.t_s.size() ? curve.t_s[i + 1] - curve.t_s[i] : 0;
  const double usual_s = std::max(before_s, after_s);
  return usual_s > 0 && curve.t_s[i] - curve.t_s[i - 1] > std::max(times_its_neighbours * usual_s, shortest_s);
}

}  // namespace

std::optional<Window> first_gap(const Curve& curve, Window window, double shortest_s) {
  for (auto i = std::max<std::size_t>(1, first_at_or_after(curve, window.begin_s));
       i < curve.t_s.size() && curve.t_s[i - 1] < window.end_s; ++i)
    if (curve.t_s[i] > window.begin_s && is_gap(curve, i, shortest_s)) return Window{curve.t_s[i - 1], curve.t_s[i]};
  return std::nullopt;
}

std::optional<Window> first_gap(const Curve& curve, Window window) {
  return first_gap(curve, window, shortest_gap_s(window));
}

bool reaches_end(const Curve& curve, Window window) {
  const auto n = curve.t_s.size();
  return n >= 2 && curve.t_s.back() > window.begin_s &&
         is_one_interval(window.end_s - curve.t_s.back(), curve.t_s[n - 1] - curve.t_s[n - 2], curve, window);
}

bool covers(const Curve& curve, Window window) {
  return window.end_s > window.begin_s && reaches_begin(curve, window) && reaches_end(curve, window) &&
         !first_gap(curve, window);
}

std::string coverage_remark(const Curve& curve, Window window) {
  if (curve.t_s.size() < 2) return "has fewer than two rows";
  if (!reaches_end(curve, window)) {
    if (window.end_s - curve.t_s.back() < 0.01)  // two decimals might be the same
      return fmt::format("covers {:.6g} s of a window that ends at {:.6g} s", curve.t_s.back(), window.end_s);
    return fmt::format("covers {:.2f} s of a window that ends at {:.2f} s", curve.t_s.back(), window.end_s);
  }
  if (!reaches_begin(curve, window))
    return fmt::format("begins at {:.6g} s, the window at {:.6g} s", curve.t_s.front(), window.begin_s);
  if (const auto gap = first_gap(curve, window))
    return fmt::format("has no rows between {:.4g} and {:.4g} s", gap->begin_s, gap->end_s);
  return "";
}

std::optional<Window> common_window(const Curve& a, const Curve& b, Window window) {
  const Window common = clipped(a, clipped(b, window));
  if (common.end_s <= common.begin_s) return std::nullopt;
  return common;
}

std::optional<double> value_at(const Curve& curve, double t_s) {
  if (curve.t_s.empty() || t_s < curve.t_s.front() || t_s > curve.t_s.back()) return std::nullopt;
  const auto right = first_at_or_after(curve, t_s);
  const auto left = right == 0 ? 0 : right - 1;
  return values_at({curve.t_s.subspan(left, right - left + 1), curve.value.subspan(left, right - left + 1)}, {t_s})[0];
}

std::optional<Peak> peak(const Curve& curve, Window window) {
  if (!covers(curve, window)) return std::nullopt;
  return largest_sample(curve, window);
}

std::optional<Peak> peak(const MeasuredSeries& series, Window window) {
  if (!covers(series, window)) return std::nullopt;
  return largest_sample({series.t_s, series.maximum}, window);
}

Series running_mean(const Series& series, double window_s) {
  Series mean{series.name, series.unit, series.t_s, series.value};
  if (series.t_s.size() < 2) return mean;
  const CumulativeIntegral integral(series);
  for (std::size_t i = 1; i + 1 < series.t_s.size(); ++i) {
    const double t = series.t_s[i];
    const double half = std::min({0.5 * window_s, t - series.t_s.front(), series.t_s.back() - t});
    if (half > 0) mean.value[i] = integral.between(t - half, t + half) / (2 * half);
  }
  return mean;
}

Series running_mean(const MeasuredSeries& series, double window_s) {
  Series mean{series.name, series.unit, {}, {}};
  if (series.t_s.empty()) return mean;
  // The integral of a series of means is known exactly at the edges and linear between them: a curve of its own.
  std::vector<double> edges{bin(series, 0).begin_s};
  std::vector<double> integral{0};
  for (std::size_t k = 0; k < series.t_s.size(); ++k) {
    edges.push_back(bin(series, k).end_s);
    integral.push_back(integral.back() + series.mean[k] * series.bin_s);
  }
  const Curve upto(edges, integral);
  const double rounding = 1e-6 * series.bin_s;
  const double half = 0.5 * window_s;
  for (const double edge : edges) {
    if (edge - half < edges.front() - rounding || edge + half > edges.back() + rounding) continue;
    const double begin = value_at(upto, std::max(edge - half, edges.front())).value();
    const double end = value_at(upto, std::min(edge + half, edges.back())).value();
    mean.t_s.push_back(edge);
    mean.value.push_back((end - begin) / window_s);
  }
  return mean;
}

std::optional<Peak> smoothed_peak(const Series& series, Window window, double smoothing_s) {
  if (!covers(series, window)) return std::nullopt;
  return largest_sample(running_mean(series, smoothing_s), window);
}

std::optional<Peak> smoothed_peak(const MeasuredSeries& series, Window window, double smoothing_s) {
  if (!covers(series, window)) return std::nullopt;
  if (!series.smoothed_maximum.empty() && std::abs(series.smoothing_s - smoothing_s) < 1e-6) {
    return largest_sample({series.t_s, series.smoothed_maximum}, window);
  }
  if (series.bin_s > smoothing_s + 1e-9) return std::nullopt;
  const double half = 0.5 * smoothing_s - 1e-9;
  const Window within{window.begin_s + half, window.end_s - half};
  const Series mean = running_mean(series, smoothing_s);
  if (within.end_s <= within.begin_s || mean.t_s.empty()) return std::nullopt;
  return largest_sample(mean, within);
}

std::optional<double> arrival_time(const Curve& curve, Window window, double threshold) {
  // Only what lies before the crossing has to be there.
  if (!reaches_begin(curve, window) || curve.t_s.back() <= window.begin_s) return std::nullopt;
  const auto n = curve.t_s.size();
  const double begin = std::max(window.begin_s, curve.t_s.front());
  double t0 = begin;
  double v0 = value_at(curve, begin).value();
  if (v0 >= threshold) return std::nullopt;
  for (auto i = first_at_or_after(curve, begin); i < n; ++i) {
    const double t1 = curve.t_s[i];
    const double v1 = curve.value[i];
    if (i > 0 && is_gap(curve, i, shortest_gap_s(window))) return std::nullopt;
    if (v1 >= threshold) {
      const double t = t0 + (t1 - t0) * (threshold - v0) / (v1 - v0);
      return t <= window.end_s ? std::optional(t) : std::nullopt;
    }
    if (t1 > window.end_s) break;
    t0 = t1;
    v0 = v1;
  }
  return std::nullopt;
}

std::optional<double> arrival_at_fraction_of_peak(const Curve& curve, Window window, double fraction) {
  const auto top = peak(curve, window);
  if (!top) return std::nullopt;
  return arrival_time(curve, window, fraction * top->value);
}

namespace {

/// Where in a bin, 0..1, a series passes the threshold that its minimum and maximum enclose, taken to rise in a
/// straight ramp from the one to the other that begins late or ends early in the bin, so as to give the bin's mean.
double crossing_in_bin(double minimum, double mean, double maximum, double threshold) {
  if (threshold <= minimum) return 0;
  const double filled = (mean - minimum) / (maximum - minimum);
  const double level = (threshold - minimum) / (maximum - minimum);
  const double ramp_begin = std::max(0.0, 1 - 2 * filled);
  const double ramp_end = std::min(1.0, 2 - 2 * filled);
  return ramp_begin + level * (ramp_end - ramp_begin);
}

}  // namespace

std::optional<double> arrival_time(const MeasuredSeries& series, Window window, double threshold) {
  if (!covers(series, {window.begin_s, window.begin_s})) return std::nullopt;
  const Curve maxima(series.t_s, series.maximum);
  const auto first = first_at_or_after(maxima, window.begin_s);
  for (auto k = first; k < series.t_s.size() && series.t_s[k] <= window.end_s; ++k) {
    if (series.maximum[k] < threshold) continue;
    if (k == first) return std::nullopt;
    const double share = crossing_in_bin(series.minimum[k], series.mean[k], series.maximum[k], threshold);
    return bin(series, k).begin_s + share * series.bin_s;
  }
  return std::nullopt;
}

std::optional<double> arrival_at_fraction_of_peak(const MeasuredSeries& series, Window window, double fraction) {
  const auto top = peak(series, window);
  if (!top) return std::nullopt;
  return arrival_time(series, window, fraction * top->value);
}

std::optional<double> impulse(const Curve& curve, Window window) {
  if (!covers(curve, window)) return std::nullopt;
  return CumulativeIntegral(curve).between(window.begin_s, window.end_s);
}

std::optional<double> impulse(const MeasuredSeries& series, Window window) {
  if (!covers(series, window)) return std::nullopt;
  double sum = 0;
  for (std::size_t k = 0; k < series.t_s.size(); ++k) sum += series.mean[k] * shared_s(bin(series, k), window);
  return sum;
}

std::optional<double> relative_deviation(std::optional<double> simulated, std::optional<double> measured) {
  if (!simulated || !measured || *measured == 0) return std::nullopt;
  return (*simulated - *measured) / *measured;
}

std::optional<double> unsigned_relative_deviation(std::optional<double> simulated, std::optional<double> measured) {
  const auto deviation = relative_deviation(simulated, measured);
  if (!deviation) return std::nullopt;
  return std::abs(*deviation);
}

}  // namespace sluice
