#include "reports/quantity.h"

#include <map>

namespace sluice {

const Quantity& quantity_of(SensorKind kind) {
  static const std::map<SensorKind, Quantity> quantities{
      {SensorKind::pressure, {"pressure", "Pressures", "pressure at", "Pa", "Pa s", 0, "kPa", 1e-3, true}},
      {SensorKind::wave_height, {"wave", "Wave heights", "water height at", "m", "m s", 3, "m", 1, false}},
      {SensorKind::force, {"force", "Forces", "force", "N", "N s", 2, "N", 1, true}},
      {SensorKind::velocity, {"velocity", "Velocities", "velocity at", "m/s", "m", 3, "m/s", 1, false}},
  };
  return quantities.at(kind);
}

}  // namespace sluice
