// How a report names, scales and files what a kind of sensor reads.
#pragma once

#include <string>

#include "validation/case.h"

namespace sluice {

struct Quantity {
  std::string stem;          ///< of figures and tables: "pressure", "wave", "force", "velocity"
  std::string title;         ///< "Pressures"
  std::string what;          ///< of an axis, before the sensor's name: "pressure at"
  std::string unit;          ///< of tables: "Pa"
  std::string impulse_unit;  ///< "Pa s"
  int decimals = 0;          ///< in tables
  std::string drawn_unit;    ///< of figures: "kPa"
  double drawn_scale = 1;    ///< a reading times this is in `drawn_unit`
  bool spikes = false;       ///< long views show a running mean, for the raw readings' spikes would hide all else
};

const Quantity& quantity_of(SensorKind kind);

}  // namespace sluice
