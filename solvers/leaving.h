// Which fluid particles have left the tank, for every solver alike.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/fields.h"
#include "solvers/solver.h"
#include "solvers/tank.h"

namespace sluice {

/// Marks in `leaves` (one element a fluid particle, which are those of `position_m` from `first` on; nonzero: it has
/// left) and counts them. Throws std::runtime_error where positions are no numbers; the message gives the step and
/// time.
LostParticles find_leaving(const Tank& tank, const VectorField<double>& position_m, std::size_t first,
                           std::vector<std::uint8_t>& leaves, const Solver& solver, int threads);

}  // namespace sluice
