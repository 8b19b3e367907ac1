// How a result depends on the particle distance: observed order and grid convergence index after Roache and Celik et
// al. (2008, J. Fluids Eng. 130:078001), for refinement ratios that need not be equal.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace sluice {

/// One result at one particle distance.
struct ResolvedValue {
  double l0_m = 0;
  double value = 0;
};

struct GridConvergence {
  bool asymptotic = false;
  std::optional<double> order;  ///< observed, from the three finest; missing when they do not converge monotonically
  std::optional<double> extrapolated;  ///< Richardson's value at l0 = 0; only in the asymptotic range
  /// Of the finest result, relative to it: 1.25 |extrapolated - finest| / |finest|; only in the asymptotic range.
  std::optional<double> index;

  /// "in the asymptotic range" or "not in the asymptotic range".
  std::string_view verdict() const;
};

/// In any order; throws std::invalid_argument for fewer than three, for equal or for non-positive particle distances.
/// The asymptotic range asks of each three neighbouring resolutions that they converge monotonically with an order
/// between `lowest_order` and `highest_order` (a second-order scheme hardly shows more than three unless by chance).
GridConvergence grid_convergence(std::vector<ResolvedValue> results, double lowest_order = 0.5,
                                 double highest_order = 3.0);

}  // namespace sluice
