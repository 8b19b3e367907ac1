// What a simulated series is scored by against a measured one. Pure functions; each says "missing" (an empty optional)
// where a series does not cover what is asked of it, and never extrapolates.
//
// A curve is the linear interpolant of its samples, which need not be evenly spaced, so that every integral and mean
// here is weighted with time, not with samples.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/measured.h"
#include "validation/series.h"

namespace sluice {

struct Window {
  double begin_s = 0;
  double end_s = 0;
};

/// A view of a series: times increase strictly, both spans are equally long.
struct Curve {
  std::span<const double> t_s;
  std::span<const double> value;

  Curve(std::span<const double> times_s, std::span<const double> values) : t_s(times_s), value(values) {}
  Curve(const Series& series) : t_s(series.t_s), value(series.value) {}  // NOLINT: a series is a curve
};

struct Peak {
  double time_s = 0;
  double value = 0;
};

struct Lag {
  double lag_s = 0;  ///< positive: the simulated series comes late
  double correlation = 0;
};

/// Whether the curve reaches both ends of the window and has no gap in between. A gap at an end of up to one sampling
/// interval (the curve's own next to that end, or the median of those in the window if that is longer) and a tenth of
/// the window counts as reached: recordings begin with their first sample. Integrals then run over what is there.
bool covers(const Curve& curve, Window window);

/// Whether the curve reaches the end of the window, gaps or not.
bool reaches_end(const Curve& curve, Window window);

/// The first gap between samples within the window, in which rows are missing: longer than 20 times both intervals
/// beside it and than `shortest_s`. Missing when there is none.
std::optional<Window> first_gap(const Curve& curve, Window window, double shortest_s);
/// One over which a straight line would be an invention: longer than a hundredth of the window too.
std::optional<Window> first_gap(const Curve& curve, Window window);

/// Why the curve does not cover the window, such as "covers 5.89 s of a window that ends at 6.00 s"; "" when it does.
std::string coverage_remark(const Curve& curve, Window window);

/// The part of the window that both curves reach; missing when there is none.
std::optional<Window> common_window(const Curve& a, const Curve& b, Window window);

/// Linear interpolant at a time; missing outside the samples.
std::optional<double> value_at(const Curve& curve, double t_s);

/// Largest sample within the window (the first of equals). Missing when the window is not covered.
std::optional<Peak> peak(const Curve& curve, Window window);
/// From the bins' maxima; the time is the bin's centre, so good to half a bin.
std::optional<Peak> peak(const MeasuredSeries& series, Window window);

/// Time-weighted mean of the interpolant over [t - window_s/2, t + window_s/2] at each sample t; near the ends over the
/// part of it that has samples, kept symmetric about t so that a straight line stays what it is.
Series running_mean(const Series& series, double window_s);
/// The same of a binned series, at the edges between bins, where whole bins make it exact when window_s is an even
/// multiple of the bin; edges whose window would leave the series are left out.
Series running_mean(const MeasuredSeries& series, double window_s);

/// Peak of the running mean within the window. Missing when the series does not cover the window.
std::optional<Peak> smoothed_peak(const Series& series, Window window, double smoothing_s);
/// From the digest's own smoothed maxima where it has them for this width, else from those of its bins that lie in the
/// window (a sharp peak then comes out a few per cent too low). Missing where the bins are wider than the mean: a mean
/// over 50 ms is none over 10.
std::optional<Peak> smoothed_peak(const MeasuredSeries& series, Window window, double smoothing_s);

/// First time within the window at which the curve rises to the threshold, interpolated. Missing when it never does,
/// when it is there from the start, or when the curve begins after the window does.
std::optional<double> arrival_time(const Curve& curve, Window window, double threshold);
/// The same at `fraction` of the curve's own peak in the window.
std::optional<double> arrival_at_fraction_of_peak(const Curve& curve, Window window, double fraction = 0.1);
/// Of a binned series: in the first bin whose maximum reaches the threshold, where that bin's minimum, mean and maximum
/// suggest. A steep front comes out within 1 ms of what the unbinned series gives, a creeping one within a bin.
std::optional<double> arrival_time(const MeasuredSeries& series, Window window, double threshold);
std::optional<double> arrival_at_fraction_of_peak(const MeasuredSeries& series, Window window, double fraction = 0.1);

/// Integral over the window by the trapezoid rule, values at its ends interpolated [unit s]. Missing when not covered.
std::optional<double> impulse(const Curve& curve, Window window);
/// Exact for windows of whole bins; parts of bins count with their share.
std::optional<double> impulse(const MeasuredSeries& series, Window window);

/// Root of the time-mean squared difference of the two interpolants. Missing unless both cover the window.
std::optional<double> rmse(const Curve& simulated, const Curve& measured, Window window);
/// The simulated curve is averaged over each bin that lies wholly in the window before it is compared with the bin's
/// mean; bins without points of their own are left out.
std::optional<double> rmse(const Curve& simulated, const MeasuredSeries& measured, Window window);

/// Largest less smallest value within the window (bins: maxima and minima). Missing when not covered.
std::optional<double> range(const Curve& curve, Window window);
std::optional<double> range(const MeasuredSeries& series, Window window);

/// The shift of the simulated curve at which the correlation coefficient of the two is largest, looked for within
/// +-max_lag_s on a grid of step_s and refined by a parabola. Missing when either does not cover the window, when
/// either is constant, when the best lies at the limit of the search, or when the window is shorter than four times
/// max_lag_s.
std::optional<Lag> best_lag(const Curve& simulated, const Curve& measured, Window window, double max_lag_s,
                            double step_s);

/// Share of the window's time, 0..1, in which lower <= curve <= upper. Missing unless all three cover the window.
std::optional<double> share_inside_band(const Curve& curve, const Curve& lower, const Curve& upper, Window window);
/// The band is each bin's minimum to maximum, widened by `widen_by` (the measurement's uncertainty) on both sides; bins
/// without points of their own count neither way.
std::optional<double> share_inside_band(const Curve& curve, const MeasuredSeries& band, Window window, double widen_by);

/// (simulated - measured) / measured. Missing when either is, or when measured is zero.
std::optional<double> relative_deviation(std::optional<double> simulated, std::optional<double> measured);
/// The paper's form in its tables: |simulated - measured| / measured.
std::optional<double> unsigned_relative_deviation(std::optional<double> simulated, std::optional<double> measured);

/// Root mean square of the curve less its running mean (20 ms unless told): how noisy a pressure is. Missing unless
/// covered.
std::optional<double> noise(const Series& series, Window window, double running_mean_s = 0.02);

/// A quantity of both series.
struct Pair {
  std::optional<double> simulated;
  std::optional<double> measured;

  /// Signed, relative to the measured one.
  std::optional<double> deviation() const { return relative_deviation(simulated, measured); }
  /// simulated - measured.
  std::optional<double> difference() const;
};

struct ComparisonOptions {
  double arrival_fraction = 0.1;
  double smoothing_s = 0.01;  ///< running mean of both series before the smoothed peak
  double noise_running_mean_s = 0.02;
  double max_lag_s = 0.2;
  /// Measurement uncertainty on each side of the bins' minimum to maximum, in the series' unit. Without it there is no
  /// band: the spread inside a bin of one recording says nothing of how well it would repeat.
  std::optional<double> band_widening;
};

/// Every metric of one sensor. What could not be had is empty, and `remarks` says why.
struct Comparison {
  std::string sensor;  ///< the measured series' name, such as "P1"
  std::string unit;
  Window window;
  Pair arrival_s;    ///< both at `arrival_fraction` of the measured peak, so that a spike does not move the threshold
  Pair half_peak_s;  ///< both at half of the measured peak, first time
  Pair peak;         ///< raw
  Pair peak_time_s;
  Pair smoothed_peak;  ///< after a running mean of both
  Pair smoothed_peak_time_s;
  Pair impulse;  ///< [unit s]
  std::optional<double> rmse;
  std::optional<double> rmse_over_range;  ///< rmse / (largest - smallest measured value in the window)
  std::optional<double> lag_s;            ///< positive: the simulation is late
  std::optional<double> correlation;      ///< at that lag
  std::optional<double> share_inside_band;
  Pair noise;  ///< measured: of the bin means, so only of what is slower than a bin; missing where no mean has two
  std::vector<std::string> remarks;
};

Comparison compare(const Series& simulated, const MeasuredSeries& measured, Window window,
                   const ComparisonOptions& options = {});
/// What can be said of a simulated series that nothing was measured for; arrival is at the fraction of its own peak.
Comparison describe(const Series& simulated, Window window, const ComparisonOptions& options = {});

}  // namespace sluice
