// How well a model does over many comparisons, and how far one comparison can tell the model's error from what is
// uncertain in the numbers themselves.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "validation/convergence.h"
#include "validation/measured.h"
#include "validation/metrics.h"

namespace sluice {

struct Interval {
  double lower = 0;
  double upper = 0;
};

/// Bias and scatter in the manner of the FDS validation guide (McGrattan and Toman 2011, Metrologia 48:173-180): the
/// ratio of prediction to measurement is taken as log-normal. With s^2 the variance of its logarithm and sigma_E the
/// measurements' own relative standard uncertainty, sigma_M^2 = s^2 - sigma_E^2 and
/// bias = exp(mean(ln(M/E)) + (sigma_M^2 - sigma_E^2) / 2).
struct BiasAndScatter {
  std::size_t pairs = 0;
  std::size_t left_out = 0;  ///< pairs with a value that is not positive: their ratio has no logarithm
  double bias = 1;           ///< 1.1: predictions are 10 % too large in the mean
  double scatter = 0;  ///< sigma_M, relative standard deviation about the bias; zero where sigma_E explains it all
  /// 95 %, from the percentiles of a bootstrap over the pairs with a fixed seed; missing with fewer than five pairs.
  std::optional<Interval> bias_interval;
  std::optional<Interval> scatter_interval;

  /// Not where ratios scatter so far that the log-normal form makes most of the bias: exp(scatter^2 / 2) alone is then
  /// 1.2 or more, and one reading that is ten times too small would pass for predictions that are too large.
  bool tells_bias() const { return scatter <= 0.6; }
};

struct PredictedAndMeasured {
  double predicted = 0;
  double measured = 0;

  /// Whether their ratio has a logarithm.
  bool is_usable() const { return predicted > 0 && measured > 0; }
};

std::size_t usable_pairs(const std::vector<PredictedAndMeasured>& pairs);

/// Missing with fewer than three usable pairs. Throws std::invalid_argument for a negative uncertainty.
std::optional<BiasAndScatter> bias_and_scatter(const std::vector<PredictedAndMeasured>& pairs,
                                               double measurement_uncertainty = 0);

/// Comparison error and validation uncertainty of ASME V&V 20 (2009), in the quantity's unit; uncertainties are
/// standard ones. What is not known is missing, and u_val is then only a lower bound.
struct ValidationUncertainty {
  double error = 0;                      ///< E = simulated - measured
  std::optional<double> of_resolution;   ///< u_num
  std::optional<double> of_input;        ///< u_input
  std::optional<double> of_measurement;  ///< u_D

  bool complete() const { return of_resolution && of_input && of_measurement; }
  /// u_val, the root of the sum of the squares of those known; missing when none is.
  std::optional<double> total() const;
  /// |E| <= 2 u_val: the error cannot be told from the uncertainties. Missing when u_val is.
  std::optional<bool> within() const;
};

/// u_num of the finest result: the grid convergence index over 1.15, the factor of V&V 20 for it. Missing outside the
/// asymptotic range.
std::optional<double> resolution_uncertainty(const GridConvergence& convergence, double finest_value);

/// u_D of an impulse over the window, where bins hold a scatter of points: each bin's values taken as spread evenly
/// between its lowest and highest, and all bins as wrong the same way (the careful choice). Missing for a recording,
/// whose bins say nothing of how it would repeat, and where the series does not cover the window.
std::optional<double> impulse_uncertainty(const MeasuredSeries& band, Window window);
/// u_D of the peak: of the bin that holds it.
std::optional<double> peak_uncertainty(const MeasuredSeries& band, Window window);

}  // namespace sluice
