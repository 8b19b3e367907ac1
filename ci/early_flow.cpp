#include "ci/early_flow.h"

#include <algorithm>
#include <cmath>

namespace sluice::ci {

double early_flow_end_s(double water_height_m, double gravity_m_s2) {
  return 1.2 * std::sqrt(water_height_m / gravity_m_s2);
}

std::optional<EarlyFlow> early_flow(const ProbeTable& probes, double end_s) {
  for (const char* name : {"kinetic_energy_J", "potential_energy_J", "greatest_density_ratio_1"})
    if (!probes.has(name)) return std::nullopt;
  const std::vector<double>& times_s = probes.times_s();
  const auto end = static_cast<std::size_t>(std::upper_bound(times_s.begin(), times_s.end(), end_s) - times_s.begin());
  if (end == 0 || end == times_s.size()) return std::nullopt;
  const std::vector<double>& kinetic_J = probes.values("kinetic_energy_J");
  const std::vector<double>& potential_J = probes.values("potential_energy_J");
  const std::vector<double>& density_ratio = probes.values("greatest_density_ratio_1");
  const double start_J = potential_J.front();
  if (!(start_J > 0)) return std::nullopt;
  EarlyFlow flow;
  flow.kinetic_energy_share = kinetic_J[end - 1] / start_J;
  for (std::size_t row = 0; row < end; ++row) {
    flow.energy_lost_share += 1 - (kinetic_J[row] + potential_J[row]) / start_J;
    flow.compression += density_ratio[row] - 1;
  }
  flow.energy_lost_share /= static_cast<double>(end);
  flow.compression /= static_cast<double>(end);
  return flow;
}

}  // namespace sluice::ci
