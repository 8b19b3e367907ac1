#include "validation/curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sluice {

namespace {

double interpolated(const Curve& curve, std::size_t right, double t_s) {
  const double t0 = curve.t_s[right - 1];
  const double t1 = curve.t_s[right];
  const double share = (t_s - t0) / (t1 - t0);
  return curve.value[right - 1] + share * (curve.value[right] - curve.value[right - 1]);
}

}  // namespace

CumulativeIntegral::CumulativeIntegral(const Curve& curve) : curve_(curve), at_sample_(curve.t_s.size(), 0.0) {
  if (curve.t_s.empty()) throw std::invalid_argument("the integral of a curve without samples");
  for (std::size_t i = 1; i < at_sample_.size(); ++i) {
    const double step = curve.t_s[i] - curve.t_s[i - 1];
    at_sample_[i] = at_sample_[i - 1] + 0.5 * step * (curve.value[i] + curve.value[i - 1]);
  }
}

double CumulativeIntegral::upto(double t_s) const {
  if (t_s <= curve_.t_s.front()) return 0;
  if (t_s >= curve_.t_s.back()) return at_sample_.back();
  const auto right = first_at_or_after(curve_, t_s);
  const double value = interpolated(curve_, right, t_s);
  return at_sample_[right - 1] + 0.5 * (t_s - curve_.t_s[right - 1]) * (curve_.value[right - 1] + value);
}

Window clipped(const Curve& curve, Window window) {
  if (curve.t_s.empty()) return {window.begin_s, window.begin_s - 1};
  return {std::max(window.begin_s, curve.t_s.front()), std::min(window.end_s, curve.t_s.back())};
}

std::size_t first_at_or_after(const Curve& curve, double t_s) {
  return static_cast<std::size_t>(std::lower_bound(curve.t_s.begin(), curve.t_s.end(), t_s) - curve.t_s.begin());
}

std::vector<double> merged_times(std::initializer_list<Curve> curves, Window window) {
  std::vector<double> times{window.begin_s, window.end_s};
  for (const Curve& curve : curves) {
    for (auto i = first_at_or_after(curve, window.begin_s); i < curve.t_s.size() && curve.t_s[i] < window.end_s; ++i) {
      times.push_back(curve.t_s[i]);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<double> values_at(const Curve& curve, const std::vector<double>& times_s) {
  std::vector<double> values;
  values.reserve(times_s.size());
  std::size_t right = 0;
  for (const double t : times_s) {
    while (right < curve.t_s.size() && curve.t_s[right] < t) ++right;
    if (right == curve.t_s.size() || (right == 0 && curve.t_s[0] != t)) {
      throw std::out_of_range("a value outside a curve's samples");
    }
    values.push_back(curve.t_s[right] == t ? curve.value[right] : interpolated(curve, right, t));
  }
  return values;
}

std::optional<Peak> largest_sample(const Curve& curve, Window window) {
  std::optional<Peak> best;
  for (auto i = first_at_or_after(curve, window.begin_s); i < curve.t_s.size() && curve.t_s[i] <= window.end_s; ++i) {
    if (!best || curve.value[i] > best->value) best = Peak{curve.t_s[i], curve.value[i]};
  }
  return best;
}

Window bin(const MeasuredSeries& series, std::size_t k) {
  return {series.t_s[k] - 0.5 * series.bin_s, series.t_s[k] + 0.5 * series.bin_s};
}

bool covers(const MeasuredSeries& series, Window window) {
  if (series.t_s.empty()) return false;
  const double rounding = 1e-6 * series.bin_s;
  return bin(series, 0).begin_s <= window.begin_s + rounding &&
         bin(series, series.t_s.size() - 1).end_s >= window.end_s - rounding;
}

double shared_s(Window a, Window b) {
  return std::max(0.0, std::min(a.end_s, b.end_s) - std::max(a.begin_s, b.begin_s));
}

double share_not_negative(double a_begin, double a_end, double b_begin, double b_end) {
  double from = 0;
  double to = 1;
  for (const auto& [begin, end] : {std::pair{a_begin, a_end}, std::pair{b_begin, b_end}}) {
    if (begin < 0 && end < 0) return 0;
    if (begin < 0) from = std::max(from, begin / (begin - end));
    if (end < 0) to = std::min(to, begin / (begin - end));
  }
  return std::max(0.0, to - from);
}

}  // namespace sluice
