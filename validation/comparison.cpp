// All metrics of one sensor at once, with the reasons for what is missing.
#include <fmt/format.h>

#include <algorithm>

#include "validation/curve.h"
#include "validation/metrics.h"

namespace sluice {

namespace {

void set_peak(const std::optional<Peak>& peak, std::optional<double>& value, std::optional<double>& time_s) {
  if (!peak) return;
  value = peak->value;
  time_s = peak->time_s;
}

void add_simulated(Comparison& result, const Series& simulated, const ComparisonOptions& options) {
  const Window window = result.window;
  set_peak(peak(simulated, window), result.peak.simulated, result.peak_time_s.simulated);
  set_peak(smoothed_peak(simulated, window, options.smoothing_s), result.smoothed_peak.simulated,
           result.smoothed_peak_time_s.simulated);
  result.impulse.simulated = impulse(simulated, window);
  result.noise.simulated = noise(simulated, window, options.noise_running_mean_s);
}

void add_measured(Comparison& result, const MeasuredSeries& measured, const ComparisonOptions& options) {
  const Window window = result.window;
  set_peak(peak(measured, window), result.peak.measured, result.peak_time_s.measured);
  set_peak(smoothed_peak(measured, window, options.smoothing_s), result.smoothed_peak.measured,
           result.smoothed_peak_time_s.measured);
  result.impulse.measured = impulse(measured, window);
  // A mean over one bin or less takes nothing away, so that what is left would be no noise.
  if (covers(measured, window) && measured.bin_s < options.noise_running_mean_s - 1e-9) {
    const Series means{measured.name, measured.unit, measured.t_s, measured.mean};
    result.noise.measured = noise(means, window, options.noise_running_mean_s);
  }
}

void add_arrivals(Comparison& result, const Series& simulated, const MeasuredSeries& measured,
                  const ComparisonOptions& options) {
  if (!result.peak.measured) return;
  const double threshold = options.arrival_fraction * *result.peak.measured;
  result.arrival_s.measured = arrival_time(measured, result.window, threshold);
  result.arrival_s.simulated = arrival_time(simulated, result.window, threshold);
  result.half_peak_s.measured = arrival_time(measured, result.window, 0.5 * *result.peak.measured);
  result.half_peak_s.simulated = arrival_time(simulated, result.window, 0.5 * *result.peak.measured);
  if (!result.arrival_s.measured) {
    result.remarks.push_back("no measured arrival: the series is over the threshold from the start");
  } else if (!result.arrival_s.simulated && covers(simulated, result.window)) {
    const auto from = std::lower_bound(simulated.t_s.begin(), simulated.t_s.end(), result.window.begin_s);
    const bool has_begin = from != simulated.t_s.end();
    result.remarks.push_back(
        has_begin && simulated.value[static_cast<std::size_t>(from - simulated.t_s.begin())] >= threshold
            ? fmt::format("no simulated arrival: the series is over {:.4g} {} from the start", threshold, result.unit)
            : fmt::format("no simulated arrival: the series does not rise to {:.4g} {}", threshold, result.unit));
  }
}

void add_lag(Comparison& result, const Series& simulated, const MeasuredSeries& measured,
             const ComparisonOptions& options) {
  // The bins have averaged the measured series; the simulated one is averaged alike, so that neither is the sharper.
  const Series averaged = running_mean(simulated, measured.bin_s);
  const double step_s = measured.bin_s / 5;
  const auto lag = best_lag(averaged, {measured.t_s, measured.mean}, result.window, options.max_lag_s, step_s);
  if (lag) {
    result.lag_s = lag->lag_s;
    result.correlation = lag->correlation;
  } else {
    result.remarks.push_back(fmt::format("no lag of best correlation within {} s", options.max_lag_s));
  }
}

}  // namespace

std::optional<double> Pair::difference() const {
  if (!simulated || !measured) return std::nullopt;
  return *simulated - *measured;
}

Comparison describe(const Series& simulated, Window window, const ComparisonOptions& options) {
  Comparison result;
  result.sensor = simulated.name;
  result.unit = simulated.unit;
  result.window = window;
  add_simulated(result, simulated, options);
  result.arrival_s.simulated = arrival_at_fraction_of_peak(simulated, window, options.arrival_fraction);
  result.half_peak_s.simulated = arrival_at_fraction_of_peak(simulated, window, 0.5);
  if (const std::string remark = coverage_remark(simulated, window); !remark.empty())
    result.remarks.push_back("the simulated series " + remark);
  return result;
}

Comparison compare(const Series& simulated, const MeasuredSeries& measured, Window window,
                   const ComparisonOptions& options) {
  Comparison result;
  result.sensor = measured.name;
  result.unit = measured.unit;
  result.window = window;
  add_simulated(result, simulated, options);
  add_measured(result, measured, options);
  add_arrivals(result, simulated, measured, options);
  if (!covers(measured, window)) {
    result.remarks.push_back("the measured series does not run over the whole window");
  }
  if (!covers(simulated, window)) {
    result.remarks.push_back("the simulated series " + coverage_remark(simulated, window));
  } else if (covers(measured, window)) {
    result.rmse = rmse(simulated, measured, window);
    if (const auto span = range(measured, window); result.rmse && span && *span > 0) {
      result.rmse_over_range = *result.rmse / *span;
    }
    add_lag(result, simulated, measured, options);
    if (options.band_widening) {
      result.share_inside_band = share_inside_band(simulated, measured, window, *options.band_widening);
    }
  }
  return result;
}

}  // namespace sluice
