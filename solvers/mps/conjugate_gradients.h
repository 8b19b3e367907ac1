// Conjugate gradients for the pressure equation: vectors and dot products in double precision, dot products summed by
// blocks of fixed length, so that results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solvers/mps/pressure_matrix.h"

namespace sluice::mps {

struct Convergence {
  int iterations = 0;
  double relative_residual = 0;  ///< |b - A x| / |b|
  bool converged = false;
};

/// The preconditioner applied to r: in the matrix's precision, which is good enough for directions.
template <class Real>
using PreconditionerCall = std::function<std::span<const Real>(std::span<const double> r)>;

/// Keeps its work vectors between solutions.
template <class Real>
class ConjugateGradients {
 public:
  explicit ConjugateGradients(int threads) : threads_(threads) {}

  /// Improves x until |b - A x| <= tolerance |b|. The vectors are zero where the matrix has no row.
  Convergence solve(const PressureMatrix<Real>& A, std::span<const double> b, std::span<double> x,
                    const PreconditionerCall<Real>& precondition, double tolerance, int most_iterations);

  /// Relative residuals of the last solution, before the first iteration and after each.
  const std::vector<double>& history() const { return history_; }
  std::int64_t memory_bytes() const;

 private:
  /// Sums term(i) over the rows.
  template <class Term>
  double sum(const PressureMatrix<Real>& A, Term&& term);

  int threads_;
  std::vector<double> residual_, product_, partial_;
  std::vector<Real> direction_;
  std::vector<double> history_;
};

/// Jacobi, the paper's kind: z = r / diagonal.
template <class Real>
void jacobi(const PressureMatrix<Real>& A, std::span<const double> r, std::span<Real> z, int threads);

extern template class ConjugateGradients<float>;
extern template class ConjugateGradients<double>;

}  // namespace sluice::mps
