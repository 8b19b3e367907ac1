// What every term of a solver has left its mark on, while the flow is still smooth: the fluid's energies and its
// compression before anything breaks. Rounding does not grow there, so that these values repeat from build to build,
// and a coefficient that is a few per cent off shows where it would drown in the scatter of the spray later.
#pragma once

#include <optional>

#include "validation/series.h"

namespace sluice::ci {

struct EarlyFlow {
  double kinetic_energy_share = 0;  ///< kinetic energy at the end of the early flow / potential energy at the start
  double energy_lost_share = 0;     ///< 1 - (kinetic + potential) / potential at the start, mean over the early flow
  double compression = 0;           ///< greatest density ratio - 1, mean over the early flow
};

/// The end of the early flow: 1.2 sqrt(H/g). A column of height H has begun to run out, and has met nothing yet.
double early_flow_end_s(double water_height_m, double gravity_m_s2);

/// nullopt where the probes lack the energies or the greatest density ratio, or end too early.
std::optional<EarlyFlow> early_flow(const ProbeTable& probes, double end_s);

}  // namespace sluice::ci
