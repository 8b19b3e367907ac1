// Direct solution of a pressure matrix by CHOLMOD's simplicial factorisation (LGPL; its supernodal module, which is
// GPL, is never used): the coarsest level of the multigrid, and the known answer of tests.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solvers/mps/pressure_matrix.h"

namespace sluice::mps {

class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  /// Throws std::runtime_error if the matrix is not positive definite.
  template <class Real>
  void factorise(const PressureMatrix<Real>& A);

  /// Solves for the unknowns; elements without a row become zero. b and x have an element for every index below the
  /// matrix's end.
  template <class Real>
  void solve(std::span<const Real> b, std::span<Real> x);

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace sluice::mps
