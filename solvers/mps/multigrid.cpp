#include "solvers/mps/multigrid.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "solvers/counting_sort.h"
#include "solvers/mps/direct_solver.h"

namespace sluice::mps {
namespace {

// The matrix of near neighbours stands in for the whole one: less than half the entries to read, and few iterations
// more. Smoothing is one step of Jacobi: the spectrum of diagonal^-1 A ends near 1.3, so that it needs no damping.

/// Sums over cells make a coarse matrix too stiff; its correction is scaled up (Braess 1995, Computing 55:379). Near
/// neighbours alone make it softer than the whole matrix, so not by 1.8.
constexpr double over_correction = 1.7;
/// A level with no more unknowns than this is solved directly.
constexpr std::size_t few_unknowns = 400;
/// Rows that a thread takes at a time: those of dry walls are empty and lie together, so that halves would not be
/// equal.
constexpr int rows_at_once = 512;

}  // namespace

template <class Real>
struct Multigrid<Real>::Level {
  PressureMatrix<Real> matrix;
  std::vector<Real> x, b, scratch;
  std::vector<std::int32_t> cell;    ///< of each unknown, in the grid of the next level; no_cell where there is no row
  std::vector<std::int32_t> coarse;  ///< that cell's number on the next level, -1 where there is no row
  // The next level's unknowns: those cells of its grid that have members.
  std::int32_t nx = 0, ny = 0;
  TouchingCells touching{0, 0};
  std::vector<std::int32_t> number_of_cell;  ///< by cell of the grid, -1 if empty
  std::vector<std::int32_t> filled_cells;    ///< by number
  std::vector<std::int32_t> member_start;    ///< cells + 1
  std::vector<std::int32_t> members;
  // This level's own matrix, unless it is the finest.
  SparseRows<Real> rows;
  std::vector<Real> diagonal;
  std::vector<std::uint8_t> has_row;

  std::size_t begin() const { return matrix.begin; }
  std::size_t end() const { return matrix.end; }
  std::int32_t cell_at(std::int32_t x, std::int32_t y, std::int32_t z) const { return (z * ny + y) * nx + x; }
};

template <class Real>
Multigrid<Real>::Multigrid(const Box& domain_m, double cell_edge_m, int threads)
    : domain_(domain_m),
      cell_edge_m_(cell_edge_m),
      threads_(threads),
      coarsest_(std::make_unique<DirectSolver>()),
      row_sums_(static_cast<std::size_t>(threads)) {
  const auto cells = [&](double extent) { return static_cast<std::int32_t>(extent / cell_edge_m) + 1; };
  auto nx = cells(domain_m.upper.x - domain_m.lower.x);
  auto ny = cells(domain_m.upper.y - domain_m.lower.y);
  auto nz = cells(domain_m.upper.z - domain_m.lower.z);
  for (;;) {
    auto level = std::make_unique<Level>();
    level->nx = nx;
    level->ny = ny;
    level->touching = TouchingCells(nx, ny);
    level->number_of_cell.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
                                 static_cast<std::size_t>(nz));
    levels_.push_back(std::move(level));
    if (nx * ny * nz == 1) break;
    nx = (nx + 1) / 2;
    ny = (ny + 1) / 2;
    nz = (nz + 1) / 2;
  }
  levels_.push_back(std::make_unique<Level>());
}

template <class Real>
Multigrid<Real>::~Multigrid() = default;
template <class Real>
Multigrid<Real>::Multigrid(Multigrid&&) noexcept = default;

template <class Real>
void Multigrid<Real>::prepare(const PressureMatrix<Real>& matrix, std::span<const double> x, std::span<const double> y,
                              std::span<const double> z) {
  Level& finest = *levels_.front();
  finest.matrix = matrix;
  finest.cell.resize(matrix.end);
  const auto n = static_cast<std::int64_t>(matrix.end);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (auto k = static_cast<std::int64_t>(matrix.begin); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto at = [&](double value, double lower) {
      return static_cast<std::int32_t>((value - lower) / cell_edge_m_);
    };
    finest.cell[i] = matrix.has_row[i] == 0 ? no_cell
                                            : finest.cell_at(at(x[i], domain_.lower.x), at(y[i], domain_.lower.y),
                                                             at(z[i], domain_.lower.z));
  }
  used_levels_ = 1;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    Level& level = *levels_[l];
    level.x.resize(level.end());
    level.b.resize(level.end());
    level.scratch.resize(level.end());
    if (l > 0 && level.end() <= few_unknowns) break;
    gather_cells(l);
    sum_coarse_matrix(l);
    ++used_levels_;
  }
  Level& last = *levels_[static_cast<std::size_t>(used_levels_) - 1];
  last.x.resize(last.end());
  last.b.resize(last.end());
  last.scratch.resize(last.end());
  coarsest_->factorise(last.matrix);
}

/// Numbers the cells that hold unknowns in the grid's order, and lists the members of each.
template <class Real>
void Multigrid<Real>::gather_cells(std::size_t l) {
  Level& fine = *levels_[l];
  std::fill(fine.number_of_cell.begin(), fine.number_of_cell.end(), -1);
  fine.coarse.assign(fine.end(), -1);
  const auto begin = static_cast<std::int64_t>(fine.begin());
  const auto end = static_cast<std::int64_t>(fine.end());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t k = begin; k < end; ++k) {
    const std::int32_t cell = fine.cell[static_cast<std::size_t>(k)];
    if (cell != no_cell)
      std::atomic_ref(fine.number_of_cell[static_cast<std::size_t>(cell)]).store(0, std::memory_order_relaxed);
  }
  Level& coarse = *levels_[l + 1];
  coarse.cell.clear();
  fine.filled_cells.clear();
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(fine.number_of_cell.size()); ++c) {
    std::int32_t& number = fine.number_of_cell[static_cast<std::size_t>(c)];
    if (number < 0) continue;
    number = static_cast<std::int32_t>(coarse.cell.size());
    fine.filled_cells.push_back(c);
    coarse.cell.push_back(coarse.cell_at(c % fine.nx / 2, c / fine.nx % fine.ny / 2, c / fine.nx / fine.ny / 2));
  }
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (fine.cell[i] != no_cell) fine.coarse[i] = fine.number_of_cell[static_cast<std::size_t>(fine.cell[i])];
  }
  counting_sort(
      begin, end, coarse.cell.size(), threads_,
      [&](std::int64_t i) { return fine.coarse[static_cast<std::size_t>(i)]; }, fine.member_start, fine.members);
}

/// The entry between two cells is the sum of the entries between their members.
template <class Real>
void Multigrid<Real>::sum_coarse_matrix(std::size_t l) {
  const Level& fine = *levels_[l];
  Level& coarse = *levels_[l + 1];
  const std::size_t cells = coarse.cell.size();
  coarse.diagonal.resize(cells);
  coarse.has_row.assign(cells, 1);
  coarse.rows.reserve(cells, 32 * cells);
  do {
    coarse.rows.clear(cells);
#pragma omp parallel num_threads(threads_)
    {
      CoarseRow<Real>& sum = row_sums_[static_cast<std::size_t>(omp_get_thread_num())];
      typename SparseRows<Real>::Writer writer(coarse.rows);
#pragma omp for schedule(dynamic, 64)
      for (std::int64_t row = 0; row < static_cast<std::int64_t>(cells); ++row) {
        const auto I = static_cast<std::size_t>(row);
        sum.start(fine.filled_cells[I]);
        Real diagonal{};
        for (auto m = fine.member_start[I]; m < fine.member_start[I + 1]; ++m) {
          const auto i = static_cast<std::size_t>(fine.members[static_cast<std::size_t>(m)]);
          diagonal += fine.matrix.near_diagonal[i];
          sum.add(fine.touching, fine.matrix.near, fine.cell, i);
        }
        sum.finish(fine.touching, fine.number_of_cell, fine.matrix.near_factor);
        coarse.diagonal[I] = diagonal - sum.within();
        writer.write(I, sum.columns(), sum.values(), sum.size());
      }
    }
  } while (coarse.rows.grew_for_more());
  const Entries<Real> entries{coarse.rows.spans(), coarse.rows.columns(), coarse.rows.values()};
  coarse.matrix = {entries, {}, coarse.diagonal, coarse.diagonal, 1, coarse.has_row, 0, cells};
}

template <class Real>
std::span<const Real> Multigrid<Real>::apply(std::span<const double> r) {
  Level& finest = *levels_.front();
  const auto n = static_cast<std::int64_t>(finest.end());
#pragma omp parallel for num_threads(threads_) schedule(static, rows_at_once)
  for (auto k = static_cast<std::int64_t>(finest.begin()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    finest.b[i] = static_cast<Real>(r[i]);
    smooth_from_zero(finest, i);
  }
  correct_from_below(0);
  return finest.x;
}

template <class Real>
void Multigrid<Real>::cycle(std::size_t l) {
  Level& level = *levels_[l];
  if (static_cast<int>(l) + 1 == used_levels_) {
    coarsest_->solve(std::span<const Real>(level.b), std::span<Real>(level.x));
    return;
  }
  const auto n = static_cast<std::int64_t>(level.end());
#pragma omp parallel for num_threads(threads_) schedule(static, rows_at_once)
  for (std::int64_t i = 0; i < n; ++i) smooth_from_zero(level, static_cast<std::size_t>(i));
  correct_from_below(l);
}

template <class Real>
void Multigrid<Real>::correct_from_below(std::size_t l) {
  Level& level = *levels_[l];
  // A W-cycle below the finest level: there it costs little, and keeps the number of iterations from growing with the
  // levels.
  const int visits = l == 0 ? 1 : 2;
  for (int visit = 0; visit < visits; ++visit) {
    restrict_residual(level, *levels_[l + 1]);
    cycle(l + 1);
    correct_and_smooth(level, *levels_[l + 1]);
  }
}

template <class Real>
void Multigrid<Real>::smooth_from_zero(Level& level, std::size_t i) {
  level.x[i] = level.matrix.has_row[i] != 0 ? level.b[i] / level.matrix.near_diagonal[i] : 0;
}

template <class Real>
void Multigrid<Real>::restrict_residual(Level& fine, Level& coarse) {
  const auto n = static_cast<std::int64_t>(fine.end());
  const auto cells = static_cast<std::int64_t>(coarse.end());
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(static, rows_at_once)
    for (auto k = static_cast<std::int64_t>(fine.begin()); k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      fine.scratch[i] = fine.coarse[i] < 0
                            ? 0
                            : fine.b[i] - fine.matrix.near_diagonal[i] * fine.x[i] +
                                  fine.matrix.near_factor * off_diagonal<Real>(fine.matrix.near, i, fine.x.data());
    }
#pragma omp for schedule(static, rows_at_once)
    for (std::int64_t c = 0; c < cells; ++c) {
      const auto I = static_cast<std::size_t>(c);
      Real sum{};
      for (auto m = fine.member_start[I]; m < fine.member_start[I + 1]; ++m)
        sum += fine.scratch[static_cast<std::size_t>(fine.members[static_cast<std::size_t>(m)])];
      coarse.b[I] = sum;
    }
  }
}

template <class Real>
void Multigrid<Real>::correct_and_smooth(Level& fine, const Level& coarse) {
  const auto n = static_cast<std::int64_t>(fine.end());
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(static, rows_at_once)
    for (auto k = static_cast<std::int64_t>(fine.begin()); k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const std::int32_t J = fine.coarse[i];
      fine.scratch[i] =
          J < 0 ? 0 : fine.x[i] + static_cast<Real>(over_correction) * coarse.x[static_cast<std::size_t>(J)];
    }
#pragma omp for schedule(static, rows_at_once)
    for (auto k = static_cast<std::int64_t>(fine.begin()); k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (fine.coarse[i] < 0) continue;
      fine.x[i] = (fine.b[i] + fine.matrix.near_factor * off_diagonal<Real>(fine.matrix.near, i, fine.scratch.data())) /
                  fine.matrix.near_diagonal[i];
    }
  }
}

template <class Real>
std::vector<LevelSize> Multigrid<Real>::level_sizes() const {
  std::vector<LevelSize> sizes;
  for (std::size_t l = 0; l < static_cast<std::size_t>(used_levels_); ++l) {
    const PressureMatrix<Real>& matrix = levels_[l]->matrix;
    LevelSize size;
    for (std::size_t i = matrix.begin; i < matrix.end; ++i) {
      if (matrix.has_row[i] == 0) continue;
      const Span row = matrix.near.rows[i];
      ++size.unknowns;
      size.entries += row.end - row.begin;
    }
    sizes.push_back(size);
  }
  return sizes;
}

template <class Real>
std::int64_t Multigrid<Real>::memory_bytes() const {
  std::int64_t sum = 0;
  for (const auto& l : levels_) {
    sum += bytes(l->x) + bytes(l->b) + bytes(l->scratch) + bytes(l->cell) + bytes(l->coarse) +
           bytes(l->number_of_cell) + bytes(l->filled_cells) + l->touching.memory_bytes() + bytes(l->member_start) +
           bytes(l->members) + l->rows.memory_bytes() + bytes(l->diagonal) + bytes(l->has_row);
  }
  return sum;
}

template class Multigrid<float>;
template class Multigrid<double>;

}  // namespace sluice::mps
