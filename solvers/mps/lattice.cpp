#include "solvers/mps/lattice.h"

#include <cmath>

#include "solvers/mps/terms.h"

namespace sluice::mps {

LatticeConstants lattice_constants(double particle_distance_m, double effective_radius_m, double near_radius_m) {
  const int reach = static_cast<int>(std::ceil(effective_radius_m / particle_distance_m));
  double weights = 0;
  double near_weights = 0;
  double second_moments = 0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const double distance = particle_distance_m * std::sqrt(static_cast<double>(x * x + y * y + z * z));
        const double omega = weight(distance, effective_radius_m);
        weights += omega;
        if (distance <= near_radius_m) near_weights += omega;
        second_moments += distance * distance * omega;
      }
    }
  }
  return {weights, second_moments / weights, near_weights / weights};
}

}  // namespace sluice::mps
