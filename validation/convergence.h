// How a result depends on the particle distance: observed order and grid convergence index after Roache and Celik et
// al. (2008, J. Fluids Eng. 130:078001), for refinement ratios that need not be equal, with the safety factor of
// Oberkampf and Roy (2010, Verification and Validation in Scientific Computing, section 8.6).
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
  /// Richardson's value at l0 = 0, with the observed order or, if less, the formal one; only in the asymptotic range.
  std::optional<double> extrapolated;
  /// Of the finest result, relative to it: factor |extrapolated - finest| / |finest|; only in the asymptotic range. The
  /// factor is 1.25 where the observed order is the formal one within a tenth of it, else 3: any three values on one
  /// side of a fourth have some order.
  std::optional<double> index;

  /// "in the asymptotic range" or "not in the asymptotic range".
  std::string_view verdict() const;
};

/// In any order; throws std::invalid_argument for fewer than three, for equal or for non-positive particle distances.
/// The asymptotic range asks of each three neighbouring resolutions that they converge monotonically with an order
/// between `lowest_order` and `highest_order` (a second-order scheme hardly shows more than three unless by chance).
/// The formal order is two: that of the kernel's interpolation and of the lattice's operators inside the fluid.
GridConvergence grid_convergence(std::vector<ResolvedValue> results, double lowest_order = 0.5,
                                 double highest_order = 3.0);

}  // namespace sluice
