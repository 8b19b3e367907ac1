// The sums of a time step that change velocities and positions. Each gathers over a particle's row of the neighbour
// list in a fixed order, so that results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/mps/lattice.h"
#include "solvers/mps/neighbours.h"
#include "solvers/mps/parameters.h"
#include "solvers/mps/particles.h"

namespace sluice::mps {

/// What the sums of one run have in common.
struct OperatorConstants {
  Parameters parameters;
  LatticeConstants lattice;
  double quantum_m = 0;
  double dt_s = 0;
};

/// u* = u + dt (nu <laplacian u> + g)   [m/s]   Eq. (21), into `predicted`, for fluid particles; walls and dummies do
/// not slip: they enter the sum with their velocity, as in the paper's Eq. (19), whose neighbours are all.
template <class Pack>
void predict_velocities(const Particles<Pack>& particles, const NeighbourList<Pack>& list, const OperatorConstants& c,
                        VectorField<typename Lanes<Pack>::Real>& predicted, int threads);

struct CorrectionReport {
  std::int64_t plain_gradients = 0;  ///< particles with too few neighbours for the corrected gradient
  double greatest_move_m = 0;
};

/// du = -dt/rho <grad P>, u = u* + du, r = r* + dt du   Eqs. (24) to (26), for fluid particles.
template <class Pack>
CorrectionReport correct(Particles<Pack>& particles, const NeighbourList<Pack>& list, const OperatorConstants& c,
                         int threads);

/// <grad P> of one particle   [Pa/m]   Eq. (24), or the plain Eq. (18) with the least pressure as reference where the
/// correction matrix is close to singular (then `plain` is set).
template <class Pack>
Vec3d pressure_gradient(const Particles<Pack>& particles, const NeighbourList<Pack>& list, const OperatorConstants& c,
                        std::size_t i, bool& plain);

}  // namespace sluice::mps
