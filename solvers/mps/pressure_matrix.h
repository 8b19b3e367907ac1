// The matrix of the pressure equation, Eq. (23) times -lambda0 n0 / (2 dim): symmetric and positive definite. Row i is
//   (sum omega_ij + compressibility) P_i - sum omega_ij P_j,
// over the neighbours j that have a pressure; those at the free surface have P = 0 and no row. Entries of dummy
// particles, which have no pressure either, may stand in a row: vectors are zero there too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solvers/mps/sparse_rows.h"

namespace sluice::mps {

/// A view. Vectors that it is applied to have an element for every index below `end`, zero where there is no row.
template <class Real>
struct PressureMatrix {
  std::span<const Span> rows;  ///< off-diagonal entries of each row in columns and weights
  const std::int32_t* columns = nullptr;
  const Real* weights = nullptr;          ///< omega_ij >= 0; the entry is -omega_ij
  std::span<const Real> diagonal;         ///< positive
  std::span<const std::uint8_t> has_row;  ///< the unknowns
  std::size_t begin = 0;                  ///< rows lie in begin .. end - 1
  std::size_t end = 0;
};

/// sum_j omega_ij x_j of one row: as many sums side by side as a row has units, added up in a fixed order.
template <class Real, class Value>
[[gnu::always_inline]] inline Value off_diagonal(const PressureMatrix<Real>& A, std::size_t i, const Value* x) {
  const Span s = A.rows[i];
  std::array<Value, row_unit> sums{};
  for (std::uint32_t k = s.begin; k < s.end; k += row_unit) {
    for (std::uint32_t m = 0; m < row_unit; ++m) sums[m] += static_cast<Value>(A.weights[k + m]) * x[A.columns[k + m]];
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace sluice::mps
