// One row of a coarse matrix of the multigrid while it is summed from the rows of the cell's members.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solvers/mps/pressure_matrix.h"

namespace sluice::mps {

template <class Real>
class CoarseRow {
 public:
  /// For columns 0 .. cells, of which the last stands for entries that lead to no cell.
  void make_room(std::size_t cells) {
    if (place_.size() <= cells) place_.resize(cells + 1, -1);
    nowhere_ = static_cast<std::int32_t>(cells);
  }

  /// Starts the row of cell I. Its first two columns are `nowhere` and I itself.
  void start(std::int32_t I) {
    columns_.clear();
    values_.clear();
    place_of(nowhere_);
    place_of(I);
  }

  /// Adds the entries of one row of the finer matrix; `coarse` is the cell of each of its columns, or negative.
  /// Neighbouring entries mostly go to one cell, and each addition would wait for the one before: so they take turns.
  void add(const Entries<Real>& entries, const std::vector<std::int32_t>& coarse, std::size_t i) {
    const Span row = entries.rows[i];
    for (std::uint32_t k = row.begin; k < row.end; ++k) {
      const std::int32_t J = coarse[static_cast<std::size_t>(entries.columns[k])];
      values_[place_of(J < 0 ? nowhere_ : J)][(k - row.begin) % turns] += entries.weights[k];
    }
  }

  /// Sums, times a factor.
  void finish(Real factor) {
    totals_.clear();
    for (const auto& v : values_) totals_.push_back(factor * ((v[0] + v[1]) + (v[2] + v[3])));
    for (const std::int32_t J : columns_) place_[static_cast<std::size_t>(J)] = -1;
  }

  // After finish().
  Real within() const { return totals_[1]; }  ///< sum of the entries inside the cell
  const std::int32_t* columns() const { return columns_.data() + 2; }
  const Real* values() const { return totals_.data() + 2; }
  std::size_t size() const { return columns_.size() - 2; }

 private:
  static constexpr std::size_t turns = 4;

  std::size_t place_of(std::int32_t J) {
    std::int32_t& place = place_[static_cast<std::size_t>(J)];
    if (place < 0) {
      place = static_cast<std::int32_t>(columns_.size());
      columns_.push_back(J);
      values_.push_back({});
    }
    return static_cast<std::size_t>(place);
  }

  std::int32_t nowhere_ = 0;
  std::vector<std::int32_t> place_;    ///< of a column in this row, -1 for none
  std::vector<std::int32_t> columns_;  ///< by place
  std::vector<std::array<Real, turns>> values_;
  std::vector<Real> totals_;
};

}  // namespace sluice::mps
