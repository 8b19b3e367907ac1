#include "validation/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <stdexcept>

namespace sluice {

namespace {

constexpr std::size_t fewest_pairs = 3;
constexpr std::size_t fewest_for_interval = 5;
constexpr std::size_t resamples = 4000;

struct Moments {
  double mean = 0;
  double variance = 0;
};

Moments moments(std::span<const double> values) {
  Moments m;
  for (const double v : values) m.mean += v / static_cast<double>(values.size());
  for (const double v : values) m.variance += (v - m.mean) * (v - m.mean) / static_cast<double>(values.size() - 1);
  return m;
}

double scatter_of(const Moments& log_ratio, double sigma_e) {
  return std::sqrt(std::max(0.0, log_ratio.variance - sigma_e * sigma_e));
}

double bias_of(const Moments& log_ratio, double sigma_e) {
  const double sigma_m = scatter_of(log_ratio, sigma_e);
  return std::exp(log_ratio.mean + 0.5 * (sigma_m * sigma_m - sigma_e * sigma_e));
}

/// The middle 95 %.
Interval middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t tail = values.size() / 40;
  return {values[tail], values[values.size() - 1 - tail]};
}

void add_intervals(BiasAndScatter& found, const std::vector<double>& log_ratios, double sigma_e) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same report from the same runs
  std::vector<double> biases;
  std::vector<double> scatters;
  std::vector<double> sample(log_ratios.size());
  for (std::size_t k = 0; k < resamples; ++k) {
    for (double& value : sample) value = log_ratios[random() % log_ratios.size()];
    const Moments m = moments(sample);
    biases.push_back(bias_of(m, sigma_e));
    scatters.push_back(scatter_of(m, sigma_e));
  }
  found.bias_interval = middle(std::move(biases));
  found.scatter_interval = middle(std::move(scatters));
}

/// Standard deviation of what lies evenly between a bin's lowest and highest value.
double bin_uncertainty(const MeasuredSeries& band, std::size_t bin) {
  return (band.maximum[bin] - band.minimum[bin]) / std::sqrt(12.0);
}

}  // namespace

std::size_t usable_pairs(const std::vector<PredictedAndMeasured>& pairs) {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const PredictedAndMeasured& pair) { return pair.is_usable(); }));
}

std::optional<BiasAndScatter> bias_and_scatter(const std::vector<PredictedAndMeasured>& pairs,
                                               double measurement_uncertainty) {
  if (measurement_uncertainty < 0) throw std::invalid_argument("a negative uncertainty of the measurement");
  BiasAndScatter found;
  found.pairs = usable_pairs(pairs);
  found.left_out = pairs.size() - found.pairs;
  if (found.pairs < fewest_pairs) return std::nullopt;
  std::vector<double> log_ratios;
  for (const PredictedAndMeasured& pair : pairs)
    if (pair.is_usable()) log_ratios.push_back(std::log(pair.predicted / pair.measured));
  const Moments m = moments(log_ratios);
  found.bias = bias_of(m, measurement_uncertainty);
  found.scatter = scatter_of(m, measurement_uncertainty);
  if (found.pairs >= fewest_for_interval) add_intervals(found, log_ratios, measurement_uncertainty);
  return found;
}

std::optional<double> ValidationUncertainty::total() const {
  if (!of_resolution && !of_input && !of_measurement) return std::nullopt;
  double sum = 0;
  for (const auto& u : {of_resolution, of_input, of_measurement}) sum += u.value_or(0) * u.value_or(0);
  return std::sqrt(sum);
}

std::optional<bool> ValidationUncertainty::within() const {
  const auto u_val = total();
  if (!u_val) return std::nullopt;
  return std::abs(error) <= 2 * *u_val;
}

std::optional<double> resolution_uncertainty(const GridConvergence& convergence, double finest_value) {
  if (!convergence.index) return std::nullopt;
  return *convergence.index * std::abs(finest_value) / 1.15;
}

std::optional<double> impulse_uncertainty(const MeasuredSeries& band, Window window) {
  if (band.points.empty() || !impulse(band, window)) return std::nullopt;
  MeasuredSeries spread = band;
  for (std::size_t bin = 0; bin < spread.mean.size(); ++bin) spread.mean[bin] = bin_uncertainty(band, bin);
  return impulse(spread, window);
}

std::optional<double> peak_uncertainty(const MeasuredSeries& band, Window window) {
  const auto top = peak(band, window);
  if (band.points.empty() || !top) return std::nullopt;
  const auto bin = std::find(band.t_s.begin(), band.t_s.end(), top->time_s);
  if (bin == band.t_s.end()) return std::nullopt;
  return bin_uncertainty(band, static_cast<std::size_t>(bin - band.t_s.begin()));
}

}  // namespace sluice
