// Every prediction of a quantity beside its measurement, method by method.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis.h"
#include "validation/uncertainty.h"

namespace sluice {

struct BiasMethod {
  std::string name;                         ///< "WCSPH, extrapolated walls"
  std::vector<PredictedAndMeasured> pairs;  ///< one a sensor and run, primary readings; incomplete ones are left out
};

struct BiasQuantity {
  std::string name;  ///< "Impulse of pressures [kPa s]", in the unit of figures
  std::string unit;
  std::vector<BiasMethod> methods;  ///< those with a pair
};

/// Impulse and smoothed peak of pressures and forces, arrival at them, and the highest wave.
std::vector<BiasQuantity> bias_quantities(const ReportData& data);

}  // namespace sluice
