// The two constants of the MPS operators: sums over a particle's neighbours in a full cubic lattice.
#pragma once

namespace sluice::mps {

struct LatticeConstants {
  double number_density = 0;  ///< n0   [1]   Eq. (17) on the lattice
  double lambda_m2 = 0;       ///< lambda0   [m^2]   Eq. (20)
};

/// For particle distance l0 and effective radius r_e, both in metres.
LatticeConstants lattice_constants(double particle_distance_m, double effective_radius_m);

}  // namespace sluice::mps
