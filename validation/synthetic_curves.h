// Known functions as the series that metrics are given: for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "validation/measured.h"
#include "validation/metrics.h"
#include "validation/series.h"

namespace sluice::synthetic {

using Function = std::function<double(double)>;

inline Series sampled_evenly(const Function& f, Window window, double step_s) {
  Series series{"P1", "Pa", {}, {}};
  const auto count = std::lround((window.end_s - window.begin_s) / step_s);
  for (long i = 0; i <= count; ++i) {
    const double t =
        window.begin_s + (window.end_s - window.begin_s) * static_cast<double>(i) / static_cast<double>(count);
    series.t_s.push_back(t);
    series.value.push_back(f(t));
  }
  return series;
}

/// Intervals between 0.4 and 1.6 of the step; the window's ends are samples.
inline Series sampled_unevenly(const Function& f, Window window, double step_s) {
  Series series = sampled_evenly(f, window, step_s);
  for (std::size_t i = 1; i + 1 < series.t_s.size(); ++i) {
    series.t_s[i] += 0.3 * step_s * std::sin(7.0 * static_cast<double>(i));
    series.value[i] = f(series.t_s[i]);
  }
  return series;
}

/// Bins from t = 0, each seen at 50 points: their trapezoid mean, smallest and largest.
inline MeasuredSeries binned(const Function& f, double bin_s, int bins) {
  constexpr int points = 50;
  MeasuredSeries series{"P1", "Pa", {}, {}, {}, {}, bin_s, {}, 0};
  for (int k = 0; k < bins; ++k) {
    double sum = 0;
    double low = f(k * bin_s);
    double high = low;
    for (int i = 0; i <= points; ++i) {
      const double value = f((k + static_cast<double>(i) / points) * bin_s);
      sum += (i == 0 || i == points ? 0.5 : 1.0) * value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    series.t_s.push_back((k + 0.5) * bin_s);
    series.mean.push_back(sum / points);
    series.minimum.push_back(low);
    series.maximum.push_back(high);
  }
  return series;
}

}  // namespace sluice::synthetic
