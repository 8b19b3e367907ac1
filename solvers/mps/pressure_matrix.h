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

/// Which entries of each row count, and what stands on the diagonal.
template <class Real>
struct MatrixRows {
  std::span<const Span> entries;  ///< off-diagonal entries of each row
  const std::int32_t* columns = nullptr;
  const Real* weights = nullptr;   ///< omega_ij >= 0; the entry is -factor omega_ij
  std::span<const Real> diagonal;  ///< positive
  Real factor = 1;                 ///< of the off-diagonal entries
};

/// A view. Vectors that it is applied to have an element for every index below `end`, zero where there is no row.
template <class Real>
struct PressureMatrix {
  MatrixRows<Real> all;
  MatrixRows<Real> near;                  ///< its like with the nearest neighbours only, good enough to smooth with
  std::span<const std::uint8_t> has_row;  ///< the unknowns
  std::size_t begin = 0;                  ///< rows lie in begin .. end - 1
  std::size_t end = 0;
};

/// factor sum_j omega_ij x_j of row i: as many sums side by side as a row has units, added up in a fixed order. Behind
/// a row's entries there may be others up to a whole unit; they are read, and count nothing.
template <class Real, class Value>
[[gnu::always_inline]] inline Value off_diagonal(const MatrixRows<Real>& rows, std::size_t i, const Value* x) {
  const Span s = rows.entries[i];
  std::array<Value, row_unit> sums{};
  std::uint32_t k = s.begin;
  for (; k + row_unit <= s.end; k += row_unit) {
    for (std::uint32_t m = 0; m < row_unit; ++m)
      sums[m] += static_cast<Value>(rows.weights[k + m]) * x[rows.columns[k + m]];
  }
  if (const std::uint32_t left = s.end - k; left > 0) {
    for (std::uint32_t m = 0; m < row_unit; ++m)
      sums[m] += (m < left ? static_cast<Value>(rows.weights[k + m]) : Value{}) * x[rows.columns[k + m]];
  }
  const Value sum = ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  return static_cast<Value>(rows.factor) * sum;
}

}  // namespace sluice::mps
