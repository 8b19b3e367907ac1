#include "ci/metric_kinds.h"

#include <algorithm>
#include <cmath>

namespace sluice::ci {
namespace {

/// Accuracy does not depend on the number of threads and repeats on one machine; from one machine to another rounding
/// differs, and with it where spray goes.
constexpr bool repeatable = true;

MetricKind accuracy(std::string_view name, Better better, double absolute, std::string_view meaning) {
  return {name, Family::accuracy, better, false, true, {absolute, 0, repeatable}, meaning};
}

/// A value of the early flow, that only a change of the method moves.
MetricKind early(std::string_view name, double relative, std::string_view meaning) {
  return {name, Family::accuracy, Better::unchanged, false, true, {0, relative, repeatable}, meaning};
}

MetricKind timing(std::string_view name, Better better, double relative, bool alarms, std::string_view meaning) {
  return {name, Family::cost, better, true, alarms, {0, relative, false}, meaning};
}

MetricKind counted(std::string_view name, double relative, std::string_view meaning) {
  return {name, Family::cost, Better::smaller, false, true, {0, relative, repeatable}, meaning};
}

std::vector<MetricKind> make_kinds() {
  using enum Better;
  return {
      accuracy("mean_impulse_error", smaller, 0.01, "mean of |impulse deviation| over the case's headline sensors"),
      accuracy("impulse_deviation", nearest_zero, 0.01, "impulse over the window, (simulated - measured) / measured"),
      accuracy("arrival_difference_s", nearest_zero, 0.005,
               "arrival at 10 % of the measured peak, simulated - measured"),
      accuracy("half_peak_time_difference_s", nearest_zero, 0.005, "first time at half of the measured peak"),
      accuracy("smoothed_peak_deviation", nearest_zero, 0.03, "largest value after a 10 ms running mean of both"),
      accuracy("peak_deviation", nearest_zero, 0.05, "largest value, (simulated - measured) / measured"),
      accuracy("peak_time_difference_s", nearest_zero, 0.01, "time of the largest value, simulated - measured"),
      accuracy("rmse_over_range", smaller, 0.005, "root mean square difference / measured range"),
      accuracy("lag_s", nearest_zero, 0.005, "shift of best correlation"),
      accuracy("share_inside_band", larger, 0.02, "share of the time inside the measured band"),
      accuracy("lost_through_walls", smaller, 0.5, "fluid particles that passed a wall"),
      accuracy("lost_over_top_share", smaller, 0.002, "fluid particles that left over the top / all at the start"),
      accuracy("number_density_max_over_n0", smaller, 0.05, "MPS: number density of the densest particle"),
      accuracy("fluid_volume_deviation", nearest_zero, 1e-4, "volume on the lattice against nominal, at the start"),
      early("kinetic_energy_share", 5e-4, "kinetic energy at 1.2 sqrt(H/g) / potential energy at the start"),
      early("energy_lost_share", 5e-4, "energy lost / potential energy at the start, mean up to 1.2 sqrt(H/g)"),
      early("compression", 5e-4, "greatest density ratio - 1, mean up to 1.2 sqrt(H/g)"),
      accuracy("finished", larger, 0.5, "1 when the run came to its end"),
      timing("cpu_time_s", smaller, 0.03, true, "processor time, all threads"),
      timing("wall_time_s", smaller, 0.03, true, "wall time"),
      timing("particle_steps_per_s", larger, 0.03, true, "fluid particles times steps, a second of stepping"),
      timing("phase_time_s", smaller, 0.05, false, "wall time of one phase"),
      counted("steps", 0.005, "time steps"),
      counted("iterations_mean", 0.02, "iterations of the pressure solver, a step"),
      counted("bytes_per_particle", 0.01, "memory of the solver / particles"),
      {"peak_memory_bytes", Family::cost, smaller, true, true, {0, 0.03, repeatable}, "largest resident memory"},
      counted("instructions", 0.002, "instructions of a fixed workload"),
      timing("time_per_iteration_s", smaller, 0.03, true, "benchmark: wall time of one iteration"),
      timing("cpu_time_per_iteration_s", smaller, 0.03, false, "benchmark: processor time of one iteration"),
      timing("items_per_second", larger, 0.03, false, "benchmark: items a second"),
      timing("bytes_per_second", larger, 0.03, false, "benchmark: bytes a second"),
  };
}

}  // namespace

const std::vector<MetricKind>& metric_kinds() {
  static const std::vector<MetricKind> kinds = make_kinds();
  return kinds;
}

const MetricKind& kind_of(std::string_view metric) {
  static const MetricKind other = timing("", Better::unknown, 0.03, false, "not known to the ledger");
  const std::size_t order = order_of(metric);
  return order < metric_kinds().size() ? metric_kinds()[order] : other;
}

std::size_t order_of(std::string_view metric) {
  const std::vector<MetricKind>& kinds = metric_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const MetricKind& kind) { return kind.name == metric; });
  return static_cast<std::size_t>(found - kinds.begin());
}

double badness(Better better, double level) {
  switch (better) {
    case Better::smaller:
      return level;
    case Better::larger:
      return -level;
    case Better::nearest_zero:
      return std::abs(level);
    case Better::unchanged:
    case Better::unknown:
      break;
  }
  return 0;
}

std::string_view to_string(Family family) {
  return family == Family::accuracy ? "accuracy" : "cost";
}

std::string_view to_string(Better better) {
  switch (better) {
    case Better::smaller:
      return "smaller";
    case Better::larger:
      return "larger";
    case Better::nearest_zero:
      return "nearest zero";
    case Better::unchanged:
      return "unchanged";
    case Better::unknown:
      break;
  }
  return "unknown";
}

}  // namespace sluice::ci
