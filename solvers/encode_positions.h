// Positions as coordinates of the path: fixed point in the fast one, metres in the reference.
#pragma once

#include "solvers/box.h"
#include "solvers/fields.h"
#include "solvers/lanes.h"

namespace sluice {

/// Coordinates of the particles first to last, the latter not included; their positions [m] must lie in the domain.
template <class Coordinate>
void encode_positions(const VectorField<double>& position_m, const Box& domain_m, std::size_t first, std::size_t last,
                      VectorField<Coordinate>& coordinate) {
  const double extent = longest_edge(domain_m);
  const FixedPoint<Coordinate> x(domain_m.lower.x, extent);
  const FixedPoint<Coordinate> y(domain_m.lower.y, extent);
  const FixedPoint<Coordinate> z(domain_m.lower.z, extent);
  for (std::size_t i = first; i < last; ++i) {
    coordinate.x[i] = x.encode(position_m.x[i]);
    coordinate.y[i] = y.encode(position_m.y[i]);
    coordinate.z[i] = z.encode(position_m.z[i]);
  }
}

}  // namespace sluice
