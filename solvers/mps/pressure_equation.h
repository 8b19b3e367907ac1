// The pressure Poisson equation of a time step, Eq. (23): which particles are at the free surface, the system for all
// others, its solution.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "solvers/mps/conjugate_gradients.h"
#include "solvers/mps/multigrid.h"
#include "solvers/mps/neighbours.h"
#include "solvers/mps/operators.h"
#include "solvers/mps/particles.h"
#include "solvers/mps/pressure_matrix.h"

namespace sluice::mps {

/// The system did not converge; the message says how far it came.
class NotConverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PressureReport {
  Convergence convergence;
  std::int64_t unknowns = 0;
  std::int64_t set_to_zero = 0;  ///< pressures that came out negative
};

template <class Pack>
class PressureEquation {
 public:
  using Real = typename Lanes<Pack>::Real;

  /// `near_radius_m`: how far apart near neighbours are at most.
  PressureEquation(const OperatorConstants& constants, double near_radius_m, const Box& domain_m, int threads);

  /// Solves for the pressures of walls and fluid from their number densities; the pressures at hand are the first
  /// guess. Negative ones become zero. Throws NotConverged.
  PressureReport solve(Particles<Pack>& particles, const NeighbourList<Pack>& list);

  /// The system of the last call, and its right-hand side: a view of the list that it was made of, until neighbours are
  /// listed anew.
  const PressureMatrix<Real>& matrix() const { return matrix_; }
  const std::vector<double>& right_side() const { return right_side_; }
  const std::vector<double>& history() const { return conjugate_gradients_.history(); }
  int levels() const { return multigrid_.levels(); }
  std::int64_t memory_bytes() const;

  /// Sets the system up without solving it.
  void assemble(const Particles<Pack>& particles, const NeighbourList<Pack>& list);

 private:
  OperatorConstants c_;
  int threads_;
  Multigrid<Real> multigrid_;
  ConjugateGradients<Real> conjugate_gradients_;
  PressureMatrix<Real> matrix_;
  std::vector<Span> far_;  ///< of far rows the entries that have a pressure
  std::vector<Real> diagonal_, near_diagonal_, jacobi_;
  std::vector<std::uint8_t> has_row_;
  std::vector<double> right_side_;
};

extern template class PressureEquation<double>;
extern template class PressureEquation<FloatPack>;

}  // namespace sluice::mps
