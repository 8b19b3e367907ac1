// Metrics that set two curves against each other over a whole window, and the noise of one against its own mean.
#include <algorithm>
#include <cmath>

#include "validation/curve.h"
#include "validation/metrics.h"

namespace sluice {

namespace {

/// Integral of the square of a function that is linear over the step.
double squared_integral(double begin, double end, double step_s) {
  return step_s * (begin * begin + begin * end + end * end) / 3;
}

std::optional<double> rms_difference(const Curve& a, const Curve& b, Window window) {
  const auto common = common_window(a, b, window);
  if (!common) return std::nullopt;
  const auto times = merged_times({a, b}, *common);
  const auto values_a = values_at(a, times);
  const auto values_b = values_at(b, times);
  double sum = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    sum += squared_integral(values_a[i - 1] - values_b[i - 1], values_a[i] - values_b[i], times[i] - times[i - 1]);
  }
  return std::sqrt(sum / (common->end_s - common->begin_s));
}

/// Values on an even grid over the window; the grid's ends may lie one sampling interval outside the samples, where the
/// nearest sample stands in.
std::vector<double> on_grid(const Curve& curve, Window window, double step_s) {
  std::vector<double> times;
  const auto count = static_cast<std::size_t>((window.end_s - window.begin_s) / step_s + 1e-6) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = window.begin_s + static_cast<double>(i) * step_s;
    times.push_back(std::clamp(t, curve.t_s.front(), curve.t_s.back()));
  }
  return values_at(curve, times);
}

/// Pearson's coefficient; missing when either is constant.
std::optional<double> correlation(std::span<const double> a, std::span<const double> b) {
  double mean_a = 0;
  double mean_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i];
    mean_b += b[i];
  }
  mean_a /= static_cast<double>(a.size());
  mean_b /= static_cast<double>(b.size());
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  // A constant leaves rounding behind, not zero.
  const double rounding = 1e-24 * static_cast<double>(a.size());
  if (aa <= rounding * mean_a * mean_a || bb <= rounding * mean_b * mean_b) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

std::optional<double> correlation_at(std::span<const double> simulated, std::span<const double> measured, long shift) {
  const auto lead = static_cast<std::size_t>(std::max(shift, 0L));
  const auto trail = static_cast<std::size_t>(std::max(-shift, 0L));
  const auto count = simulated.size() - lead - trail;
  return correlation(simulated.subspan(lead, count), measured.subspan(trail, count));
}

/// Where the parabola through three equidistant points has its top, in steps from the middle one, and how high it is.
Peak parabola_top(double left, double middle, double right) {
  const double curvature = left - 2 * middle + right;
  if (curvature >= 0) return {0, middle};
  const double at = 0.5 * (left - right) / curvature;
  return {at, middle - 0.25 * (left - right) * at};
}

}  // namespace

std::optional<double> rmse(const Curve& simulated, const Curve& measured, Window window) {
  if (!covers(simulated, window) || !covers(measured, window)) return std::nullopt;
  return rms_difference(simulated, measured, window);
}

std::optional<double> rmse(const Curve& simulated, const MeasuredSeries& measured, Window window) {
  if (!covers(simulated, window) || !covers(measured, window)) return std::nullopt;
  const CumulativeIntegral integral(simulated);
  double sum = 0;
  int bins = 0;
  for (std::size_t k = 0; k < measured.t_s.size(); ++k) {
    const Window edges = bin(measured, k);
    const Window there = clipped(simulated, edges);
    const double rounding = 1e-6 * measured.bin_s;
    const bool inside = edges.begin_s >= window.begin_s - rounding && edges.end_s <= window.end_s + rounding;
    if (!inside || !measured.has_points(k) || there.end_s <= there.begin_s) continue;
    const double mean = integral.between(there.begin_s, there.end_s) / (there.end_s - there.begin_s);
    sum += (mean - measured.mean[k]) * (mean - measured.mean[k]);
    ++bins;
  }
  if (bins == 0) return std::nullopt;
  return std::sqrt(sum / bins);
}

std::optional<double> range(const Curve& curve, Window window) {
  if (!covers(curve, window)) return std::nullopt;
  const auto first = first_at_or_after(curve, window.begin_s);
  auto last = first;
  while (last < curve.t_s.size() && curve.t_s[last] <= window.end_s) ++last;
  if (last == first) return std::nullopt;
  const auto [low, high] = std::minmax_element(curve.value.begin() + static_cast<std::ptrdiff_t>(first),
                                               curve.value.begin() + static_cast<std::ptrdiff_t>(last));
  return *high - *low;
}

std::optional<double> range(const MeasuredSeries& series, Window window) {
  if (!covers(series, window)) return std::nullopt;
  std::vector<double> negated = series.minimum;
  for (double& value : negated) value = -value;
  const auto high = largest_sample({series.t_s, series.maximum}, window);
  const auto low = largest_sample({series.t_s, negated}, window);
  if (!high || !low) return std::nullopt;
  return high->value + low->value;
}

std::optional<Lag> best_lag(const Curve& simulated, const Curve& measured, Window window, double max_lag_s,
                            double step_s) {
  if (!covers(simulated, window) || !covers(measured, window)) return std::nullopt;
  if (window.end_s - window.begin_s < 4 * max_lag_s) return std::nullopt;
  const auto a = on_grid(simulated, window, step_s);
  const auto b = on_grid(measured, window, step_s);
  const long limit = std::lround(max_lag_s / step_s);
  std::vector<double> by_shift;
  for (long shift = -limit; shift <= limit; ++shift) {
    const auto r = correlation_at(a, b, shift);
    if (!r) return std::nullopt;
    by_shift.push_back(*r);
  }
  const auto best = std::max_element(by_shift.begin(), by_shift.end());
  if (best == by_shift.begin() || best == by_shift.end() - 1) return std::nullopt;
  const Peak top = parabola_top(*(best - 1), *best, *(best + 1));
  const double steps = static_cast<double>(best - by_shift.begin() - limit) + top.time_s;
  return Lag{steps * step_s, std::min(1.0, top.value)};
}

std::optional<double> share_inside_band(const Curve& curve, const Curve& lower, const Curve& upper, Window window) {
  if (!covers(curve, window) || !covers(lower, window) || !covers(upper, window)) return std::nullopt;
  const Window common = clipped(curve, clipped(lower, clipped(upper, window)));
  if (common.end_s <= common.begin_s) return std::nullopt;
  const auto times = merged_times({curve, lower, upper}, common);
  const auto value = values_at(curve, times);
  const auto low = values_at(lower, times);
  const auto high = values_at(upper, times);
  double inside_s = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    inside_s += (times[i] - times[i - 1]) * share_not_negative(value[i - 1] - low[i - 1], value[i] - low[i],
                                                               high[i - 1] - value[i - 1], high[i] - value[i]);
  }
  return inside_s / (common.end_s - common.begin_s);
}

std::optional<double> share_inside_band(const Curve& curve, const MeasuredSeries& band, Window window,
                                        double widen_by) {
  if (!covers(curve, window) || !covers(band, window)) return std::nullopt;
  const Window common = clipped(curve, window);
  double inside_s = 0;
  double all_s = 0;
  for (std::size_t k = 0; k < band.t_s.size(); ++k) {
    const Window edges = bin(band, k);
    const Window part{std::max(edges.begin_s, common.begin_s), std::min(edges.end_s, common.end_s)};
    if (part.end_s <= part.begin_s || !band.has_points(k)) continue;
    all_s += part.end_s - part.begin_s;
    const auto times = merged_times({curve}, part);
    const auto value = values_at(curve, times);
    const double low = band.minimum[k] - widen_by;
    const double high = band.maximum[k] + widen_by;
    for (std::size_t i = 1; i < times.size(); ++i) {
      inside_s += (times[i] - times[i - 1]) *
                  share_not_negative(value[i - 1] - low, value[i] - low, high - value[i - 1], high - value[i]);
    }
  }
  if (all_s <= 0) return std::nullopt;
  return inside_s / all_s;
}

std::optional<double> noise(const Series& series, Window window, double running_mean_s) {
  if (!covers(series, window)) return std::nullopt;
  // Near the ends of the series the running mean narrows and would hide the noise: they are left out.
  const double half = 0.5 * running_mean_s;
  const Window full = clipped(
      series, {std::max(window.begin_s, series.t_s.front() + half), std::min(window.end_s, series.t_s.back() - half)});
  if (full.end_s <= full.begin_s) return std::nullopt;
  return rms_difference(series, running_mean(series, running_mean_s), full);
}

}  // namespace sluice
