// The particles of an MPS run in one index space: dummy particles, then wall particles, then fluid, so that all that
// have a pressure lie together. Fluid is sorted at every step, walls and dummies among themselves where a body moves;
// only fluid can leave.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/fields.h"
#include "solvers/lanes.h"
#include "solvers/scene.h"

namespace sluice::mps {

/// Positions and pressures in double precision, the rest in the precision of the path. Pair sums read `coordinate`.
template <class Pack>
struct Particles {
  using Real = typename Lanes<Pack>::Real;
  using Coordinate = typename Lanes<Pack>::Coordinate;

  std::size_t dummies = 0;  ///< 0 .. dummies - 1: the layers behind the walls
  std::size_t walls = 0;    ///< the layer in contact with the fluid, with a pressure of its own
  std::size_t fluid = 0;

  VectorField<double> position;        ///< [m]
  VectorField<Coordinate> coordinate;  ///< the positions in quanta of FixedPoint
  VectorField<Real> velocity;          ///< [m/s]
  std::vector<double> pressure;        ///< [Pa]
  std::vector<Real> number_density;    ///< n_i [1], of walls and fluid
  std::vector<Real> centroid_offset;   ///< sigma_i [m], of walls and fluid
  std::vector<std::int32_t> id;        ///< fluid from zero, then solids

  std::size_t first_wall() const { return dummies; }
  std::size_t first_fluid() const { return dummies + walls; }
  std::size_t size() const { return dummies + walls + fluid; }
  bool is_dummy(std::size_t i) const { return i < dummies; }
  bool is_fluid(std::size_t i) const { return i >= first_fluid(); }

  void resize(std::size_t dummy_count, std::size_t wall_count, std::size_t fluid_count);

  /// Brings the coordinates of particles first .. size() - 1 up to date with their positions.
  void encode_positions(const Box& domain_m, std::size_t first, int threads);

  /// Fluid particle k becomes what fluid particle order[k] was; the fluid shrinks to the order's length.
  void permute_fluid(std::span<const std::int32_t> order, int threads);

  /// Particle first + k becomes what particle first + from[k] was.
  void permute(std::size_t first, std::span<const std::int32_t> from);

  std::int64_t memory_bytes() const;

 private:
  std::vector<double> spare_doubles_;
  std::vector<Real> spare_values_;
  std::vector<std::int32_t> spare_ids_;
};

extern template struct Particles<double>;
extern template struct Particles<FloatPack>;

}  // namespace sluice::mps
