// The matrix of the pressure equation, Eq. (23) times -lambda0 n0 / (2 dim): symmetric and positive definite. Row i is
//   (sum omega_ij + compressibility) P_i - sum omega_ij P_j,
// over the neighbours j that have a pressure; those at the free surface have P = 0 and no row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solvers/mps/sparse_rows.h"

namespace sluice::mps {

/// Some of the entries of each row. Behind those of a row come entries of weight zero, up to a whole unit.
template <class Real>
struct Entries {
  std::span<const Span> rows;
  const std::int32_t* columns = nullptr;
  const Real* weights = nullptr;  ///< omega_ij >= 0; the entry is -omega_ij
};

/// A view. Vectors that it is applied to have an element for every index below `end`, zero where there is no row.
template <class Real>
struct PressureMatrix {
  Entries<Real> near;                     ///< off the diagonal, those of the nearest neighbours
  Entries<Real> far;                      ///< and of the others; without rows where all are near
  std::span<const Real> diagonal;         ///< positive
  std::span<const Real> near_diagonal;    ///< of a matrix with the near entries only, good enough to smooth with
  Real near_factor = 1;                   ///< by which its entries make up for those left out
  std::span<const std::uint8_t> has_row;  ///< the unknowns
  std::size_t begin = 0;                  ///< rows lie in begin .. end - 1
  std::size_t end = 0;

  bool has_far() const { return !far.rows.empty(); }
};

/// sum_j omega_ij x_j of row i, in two sums side by side of the precision asked for.
template <class Value, class Real, class Element>
[[gnu::always_inline]] inline Value off_diagonal(const Entries<Real>& entries, std::size_t i, const Element* x) {
  const Span row = entries.rows[i];
  std::array<Value, row_unit> sums{};
  for (std::uint32_t k = row.begin; k < row.end; k += row_unit) {
    for (std::uint32_t m = 0; m < row_unit; ++m)
      sums[m] += static_cast<Value>(entries.weights[k + m]) * static_cast<Value>(x[entries.columns[k + m]]);
  }
  static_assert(row_unit == 2);
  return sums[0] + sums[1];
}

/// Element i of A x, summed in double precision; zero where there is no row.
template <class Real, class Element>
[[gnu::always_inline]] inline double product(const PressureMatrix<Real>& A, std::size_t i, const Element* x) {
  if (A.has_row[i] == 0) return 0;
  auto sum = off_diagonal<double>(A.near, i, x);
  if (A.has_far()) sum += off_diagonal<double>(A.far, i, x);
  return static_cast<double>(A.diagonal[i]) * static_cast<double>(x[i]) - sum;
}

}  // namespace sluice::mps
