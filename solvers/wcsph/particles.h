// The state of a set of particles as structure of arrays: positions in double precision, all else in the precision of
// the path. Densities are deviations from the reference density.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/fields.h"
#include "solvers/lanes.h"
#include "solvers/scene.h"
#include "solvers/vec3.h"

namespace sluice::wcsph {

/// n particles; arrays that the pair loops read are longer by one pack, since a pack may reach past the last particle.
template <class Pack>
struct Particles {
  using Real = typename Lanes<Pack>::Real;
  using Coordinate = typename Lanes<Pack>::Coordinate;

  std::size_t n = 0;
  // Carried from step to step.
  VectorField<double> position;         ///< [m]
  VectorField<Real> velocity;           ///< [m/s], at t
  VectorField<Real> velocity_previous;  ///< [m/s], at t - dt
  std::vector<Real> density;            ///< rho - rho_0 [kg/m^3], at t
  std::vector<Real> density_previous;   ///< rho - rho_0 [kg/m^3], at t - dt
  std::vector<std::int32_t> id;
  // Derived in each step, for the pair loops.
  VectorField<Coordinate> coordinate;  ///< position in fixed point (the reference path: metres)
  std::vector<Real> pressure;          ///< [Pa]
  std::vector<Real> volume;            ///< m / rho [m^3]
  std::vector<Real> sound;             ///< speed of sound [m/s]
  // Rates, written by the pair loops.
  VectorField<Real> acceleration;  ///< [m/s^2]
  std::vector<Real> density_rate;  ///< [kg/(m^3 s)]

  void resize(std::size_t count);

  /// Particle k becomes what particle order[k] was; the number of particles becomes the length of the order.
  void permute(std::span<const std::int32_t> order, int threads);

  /// Copies the positions of particles first .. last - 1 into pair coordinates.
  void encode_positions(const Box& domain, std::size_t first, std::size_t last);

  std::int64_t memory_bytes() const;

 private:
  std::vector<double> spare_positions_;
  std::vector<Real> spare_values_;
  std::vector<std::int32_t> spare_ids_;
};

extern template struct Particles<double>;
extern template struct Particles<FloatPack>;

}  // namespace sluice::wcsph
