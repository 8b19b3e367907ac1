#include "ci/shifts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sluice::ci {
namespace {

/// Of a normal distribution: standard deviation / median absolute deviation.
constexpr double sigma_over_mad = 1.4826;
/// Residuals beyond this many scaled median absolute deviations are drawn in to it.
constexpr double drawn_in_beyond = 3;

double range(std::span<const double> values) {
  if (values.empty()) return 0;
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return *highest - *lowest;
}

/// The series at one night: the values since the last shift, and the residuals of all segments before it.
class Night {
 public:
  Night(std::span<const double> window, std::span<const double> earlier_residuals, const Tolerance& tolerance,
        const ShiftRule& rule)
      : window_(window), earlier_(earlier_residuals), tolerance_(tolerance), rule_(rule) {}

  /// The earliest shift in the window that fulfils every condition, with indices that count from the window's begin.
  std::optional<Shift> shift() const {
    if (const auto jump = jump_of_quiet_series()) return jump;
    if (window_.size() < rule_.least_before + rule_.nights_to_confirm) return std::nullopt;
    if (range(window_) < tolerance_.at(window_.front())) return std::nullopt;
    // Testing is costly: not before one of the places that could be named would be large enough.
    const auto places = possible_divisions(window_, rule_.division.shortest_segment);
    if (std::none_of(places.begin(), places.end(), [&](std::size_t first) { return large_shift(first).has_value(); }))
      return std::nullopt;
    for (const Division& division : e_divisive(window_, rule_.division)) {
      auto found = large_shift(division.first);
      if (!found) continue;
      found->p_value = division.p_value;
      return found;
    }
    return std::nullopt;
  }

 private:
  std::optional<Shift> jump_of_quiet_series() const {
    if (!tolerance_.repeatable || window_.size() < 2) return std::nullopt;
    const auto history = window_.first(window_.size() - 1);
    if (history.size() + earlier_.size() < rule_.quiet_values) return std::nullopt;
    const double level = median(history);
    const double tolerance = tolerance_.at(level);
    if (std::max(range(history), range(earlier_)) > tolerance / 2) return std::nullopt;
    if (window_.back() == level || std::abs(window_.back() - level) < tolerance) return std::nullopt;
    return Shift{history.size(), history.size(), level, window_.back(), scatter_of(earlier_), tolerance, std::nullopt};
  }

  /// Whether what lies behind `first` is a new level: every condition but that of significance.
  std::optional<Shift> large_shift(std::size_t first) const {
    const auto before = window_.first(first), after = window_.subspan(first);
    if (before.size() < rule_.least_before || after.size() < rule_.nights_to_confirm) return std::nullopt;
    const double old_level = trimmed_mean(before), new_level = trimmed_mean(after);
    const double difference = new_level - old_level;
    if (!confirmed(after, old_level, difference)) return std::nullopt;
    const std::vector<double> residuals = residuals_about(old_level, new_level, first);
    if (residuals.size() < rule_.least_residuals) return std::nullopt;
    const double scatter = scatter_of(residuals);
    const double caution = residuals.size() < rule_.many_residuals ? 2 : 1;
    const auto n_before = static_cast<double>(before.size()), n_after = static_cast<double>(after.size());
    const double standard_error = std::sqrt(1 / n_before + 1 / (n_after - 0.5));  // of the difference, in scatters
    const double scatters = caution * std::max(rule_.least_scatters, rule_.critical * standard_error);
    const double threshold = std::max(scatters * scatter, tolerance_.at(old_level));
    if (std::abs(difference) < threshold) return std::nullopt;
    return Shift{first, window_.size() - 1, old_level, new_level, scatter, threshold, std::nullopt};
  }

  bool confirmed(std::span<const double> after, double old_level, double difference) const {
    if (difference == 0) return false;
    const auto beyond = static_cast<std::size_t>(std::count_if(
        after.begin(), after.end(), [&](double value) { return (value - old_level) / difference > 0.5; }));
    return beyond >= rule_.nights_to_confirm &&
           static_cast<double>(beyond) >= rule_.share_beyond_middle * static_cast<double>(after.size());
  }

  std::vector<double> residuals_about(double old_level, double new_level, std::size_t first) const {
    std::vector<double> residuals(earlier_.begin(), earlier_.end());
    for (std::size_t i = 0; i < window_.size(); ++i)
      residuals.push_back(window_[i] - (i < first ? old_level : new_level));
    return residuals;
  }

  std::span<const double> window_;
  std::span<const double> earlier_;
  const Tolerance& tolerance_;
  const ShiftRule& rule_;
};

}  // namespace

double Tolerance::at(double level) const {
  return std::max(absolute, relative * std::abs(level));
}

double median(std::span<const double> values) {
  if (values.empty()) return 0;
  std::vector<double> copy(values.begin(), values.end());
  const auto middle = copy.begin() + static_cast<std::ptrdiff_t>(copy.size() / 2);
  std::nth_element(copy.begin(), middle, copy.end());
  if (copy.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(copy.begin(), middle)) / 2;
}

double trimmed_mean(std::span<const double> values) {
  if (values.empty()) return 0;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto cut = static_cast<std::ptrdiff_t>(sorted.size() / 6);
  return std::accumulate(sorted.begin() + cut, sorted.end() - cut, 0.0) /
         static_cast<double>(sorted.end() - sorted.begin() - 2 * cut);
}

double scatter_of(std::span<const double> residuals) {
  if (residuals.empty()) return 0;
  std::vector<double> sizes(residuals.begin(), residuals.end());
  for (double& size : sizes) size = std::abs(size);
  const double mad = sigma_over_mad * median(sizes);
  // Where more than half are zero the median says nothing: then all count in full.
  const double limit = mad > 0 ? drawn_in_beyond * mad : *std::max_element(sizes.begin(), sizes.end());
  double squares = 0;
  for (const double size : sizes) squares += std::pow(std::min(size, limit), 2);
  // Two levels have been taken from the values.
  const double freedom = std::max(1.0, static_cast<double>(sizes.size()) - 2);
  return std::max(mad, std::sqrt(squares / freedom));
}

std::vector<Shift> find_shifts(std::span<const double> values, const Tolerance& tolerance, const ShiftRule& rule) {
  std::vector<Shift> shifts;
  std::vector<double> earlier_residuals;
  std::size_t segment = 0;
  for (std::size_t night = 0; night < values.size(); ++night) {
    const std::size_t begin = std::max(segment, night + 1 - std::min(night + 1, rule.window));
    const auto earlier = std::span<const double>(earlier_residuals);
    const std::size_t kept = std::min(earlier.size(), rule.window - std::min(rule.window, night + 1 - begin));
    auto shift = Night(values.subspan(begin, night + 1 - begin), earlier.last(kept), tolerance, rule).shift();
    if (!shift) continue;
    shift->first += begin;
    shift->found += begin;
    for (std::size_t i = begin; i < shift->first; ++i) earlier_residuals.push_back(values[i] - shift->before);
    segment = shift->first;
    shifts.push_back(*shift);
  }
  return shifts;
}

}  // namespace sluice::ci
