// The two constants of the MPS operators: sums over a particle's neighbours in a full cubic lattice.
#pragma once

namespace sluice::mps {

struct LatticeConstants {
  double number_density = 0;  ///< n0   [1]   Eq. (17) on the lattice
  double lambda_m2 = 0;       ///< lambda0   [m^2]   Eq. (20)
  double near_share = 1;      ///< what neighbours within the near radius have in n0
};

/// For particle distance l0, effective radius r_e and near radius, all in metres.
LatticeConstants lattice_constants(double particle_distance_m, double effective_radius_m, double near_radius_m);

}  // namespace sluice::mps
