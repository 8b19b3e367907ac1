#include "validation/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace sluice {

namespace {

constexpr double formal_order = 2;

double safety_factor(double observed) {
  return std::abs(observed - formal_order) <= 0.1 * formal_order ? 1.25 : 3;
}

constexpr double order_searched = 50;

/// Ratio of the coarse to the fine difference that an error proportional to l0^order would show.
double ratio_of_differences(std::span<const ResolvedValue> fine_to_coarse, double order) {
  const double r21 = fine_to_coarse[1].l0_m / fine_to_coarse[0].l0_m;
  const double r32 = fine_to_coarse[2].l0_m / fine_to_coarse[1].l0_m;
  return std::pow(r21, order) * (std::pow(r32, order) - 1) / (std::pow(r21, order) - 1);
}

/// The order that explains three results, finest first; missing when they do not converge monotonically.
std::optional<double> observed_order(std::span<const ResolvedValue> fine_to_coarse) {
  const double fine = fine_to_coarse[1].value - fine_to_coarse[0].value;
  const double coarse = fine_to_coarse[2].value - fine_to_coarse[1].value;
  if (fine == 0 || coarse / fine <= 0) return std::nullopt;
  // The ratio grows with the order, so halving finds it.
  double low = 1e-6;
  double high = order_searched;
  if (coarse / fine <= ratio_of_differences(fine_to_coarse, low)) return std::nullopt;
  if (coarse / fine >= ratio_of_differences(fine_to_coarse, high)) return high;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (ratio_of_differences(fine_to_coarse, middle) < coarse / fine ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void check(const std::vector<ResolvedValue>& sorted) {
  if (sorted.size() < 3) {
    throw std::invalid_argument(fmt::format("grid convergence needs three resolutions, not {}", sorted.size()));
  }
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i].l0_m <= 0) throw std::invalid_argument(fmt::format("a particle distance of {} m", sorted[i].l0_m));
    if (i > 0 && sorted[i].l0_m == sorted[i - 1].l0_m) {
      throw std::invalid_argument(fmt::format("two results at the particle distance {} m", sorted[i].l0_m));
    }
  }
}

}  // namespace

std::string_view GridConvergence::verdict() const {
  return asymptotic ? "in the asymptotic range" : "not in the asymptotic range";
}

GridConvergence grid_convergence(std::vector<ResolvedValue> results, double lowest_order, double highest_order) {
  std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.l0_m < b.l0_m; });
  check(results);
  GridConvergence found;
  found.order = observed_order(std::span(results).first(3));
  for (std::size_t i = 0; i + 3 <= results.size(); ++i) {
    const auto order = observed_order(std::span(results).subspan(i, 3));
    if (!order || *order < lowest_order || *order > highest_order) return found;
  }
  found.asymptotic = true;
  const double finest = results[0].value;
  const double r21 = results[1].l0_m / results[0].l0_m;
  found.extrapolated = finest + (finest - results[1].value) / (std::pow(r21, std::min(*found.order, formal_order)) - 1);
  if (finest != 0) found.index = safety_factor(*found.order) * std::abs((*found.extrapolated - finest) / finest);
  return found;
}

}  // namespace sluice
