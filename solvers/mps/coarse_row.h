// One row of a coarse matrix of the multigrid while it is summed from the rows of the cell's members.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "solvers/fields.h"
#include "solvers/mps/pressure_matrix.h"

namespace sluice::mps {

/// What stands for a cell where an unknown has none.
constexpr std::int32_t no_cell = std::numeric_limits<std::int32_t>::min() / 2;

/// A cell and those that touch it, in a grid of nx x ny x nz cells numbered along x, then y, then z. Neighbours are no
/// further apart than a cell is wide, so that all entries of a row lead to these.
class TouchingCells {
 public:
  static constexpr std::size_t most = 27;
  static constexpr std::uint8_t nowhere = most;

  TouchingCells(std::int32_t nx, std::int32_t ny) : reach_(1 + nx + std::int64_t{nx} * ny) {
    for (std::int32_t z = -1; z <= 1; ++z)
      for (std::int32_t y = -1; y <= 1; ++y)
        for (std::int32_t x = -1; x <= 1; ++x) offsets_.push_back((z * ny + y) * nx + x);
    std::sort(offsets_.begin(), offsets_.end());
    offsets_.erase(std::unique(offsets_.begin(), offsets_.end()), offsets_.end());  // narrow grids have fewer
    slots_.assign(static_cast<std::size_t>(2 * reach_ + 1), nowhere);
    for (std::size_t slot = 0; slot < offsets_.size(); ++slot)
      slots_[static_cast<std::size_t>(offsets_[slot] + reach_)] = static_cast<std::uint8_t>(slot);
  }

  /// Of the cell `to` as seen from `from`: an index into offsets(), or nowhere.
  std::size_t slot(std::int32_t from, std::int32_t to) const {
    const auto at = static_cast<std::size_t>(to - from + reach_);
    return at < slots_.size() ? slots_[at] : nowhere;
  }
  /// From a cell's number to those of the cells that touch it, and to its own; ascending.
  const std::vector<std::int32_t>& offsets() const { return offsets_; }
  std::int64_t memory_bytes() const { return bytes(offsets_) + bytes(slots_); }

 private:
  std::int64_t reach_;
  std::vector<std::int32_t> offsets_;
  std::vector<std::uint8_t> slots_;
};

template <class Real>
class CoarseRow {
 public:
  /// Starts the row of a cell.
  void start(std::int32_t cell) {
    cell_ = cell;
    for (auto& sums : sums_) sums = {};
  }

  /// Adds the entries of row i of the finer matrix; `cell_of` is the cell of each of its columns, or no_cell.
  /// Neighbouring entries mostly go to one cell, and each addition would wait for the one before: so they take turns.
  void add(const TouchingCells& touching, const Entries<Real>& entries, const std::vector<std::int32_t>& cell_of,
           std::size_t i) {
    const Span row = entries.rows[i];
    for (std::uint32_t k = row.begin; k < row.end; ++k) {
      const std::int32_t to = cell_of[static_cast<std::size_t>(entries.columns[k])];
      sums_[touching.slot(cell_, to)][(k - row.begin) % turns] += entries.weights[k];
    }
  }

  /// Sums, times a factor; `number_of_cell` becomes the columns' numbers.
  void finish(const TouchingCells& touching, const std::vector<std::int32_t>& number_of_cell, Real factor) {
    size_ = 0;
    for (std::size_t slot = 0; slot < touching.offsets().size(); ++slot) {
      const auto& s = sums_[slot];
      const Real sum = factor * ((s[0] + s[1]) + (s[2] + s[3]));
      const std::int32_t offset = touching.offsets()[slot];
      if (offset == 0) within_ = sum;
      if (offset == 0 || !(sum > 0)) continue;
      columns_[size_] = number_of_cell[static_cast<std::size_t>(std::int64_t{cell_} + offset)];
      values_[size_++] = sum;
    }
  }

  // After finish().
  Real within() const { return within_; }  ///< sum of the entries inside the cell
  const std::int32_t* columns() const { return columns_.data(); }
  const Real* values() const { return values_.data(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t turns = 4;

  std::int32_t cell_ = 0;
  std::array<std::array<Real, turns>, TouchingCells::most + 1> sums_{};  ///< by slot, the last for nowhere
  Real within_{};
  std::size_t size_ = 0;
  std::array<std::int32_t, TouchingCells::most> columns_{};
  std::array<Real, TouchingCells::most> values_{};
};

}  // namespace sluice::mps
