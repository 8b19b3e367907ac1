// Multigrid as preconditioner of the pressure equation: unknowns are gathered into cells of 2 l0, those into cells
// twice as wide, and so on; the matrix of a coarse level sums the entries between two cells. One cycle, a V at the
// finest level and a W below it, the same forwards and backwards, so that conjugate gradients may use it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solvers/mps/coarse_row.h"
#include "solvers/mps/pressure_matrix.h"
#include "solvers/scene.h"
#include "solvers/vec3.h"

namespace sluice::mps {

class DirectSolver;

/// How much work a level is.
struct LevelSize {
  std::int64_t unknowns = 0;
  std::int64_t entries = 0;  ///< off the diagonal; on the finest level those of near neighbours
};

template <class Real>
class Multigrid {
 public:
  /// Cells of the first coarse level have this edge, at least as long as the near entries reach; the domain bounds
  /// their number.
  Multigrid(const Box& domain_m, double cell_edge_m, int threads);
  ~Multigrid();
  Multigrid(Multigrid&&) noexcept;
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;
  Multigrid& operator=(Multigrid&&) = delete;

  /// Prepares for a matrix whose unknown i lies at (x[i], y[i], z[i]) [m]. The matrix must stay while it is applied.
  void prepare(const PressureMatrix<Real>& matrix, std::span<const double> x, std::span<const double> y,
               std::span<const double> z);

  /// The cycle applied to r, in the matrix's precision; stands until the next call.
  std::span<const Real> apply(std::span<const double> r);

  int levels() const { return used_levels_; }
  /// Of the matrix at hand, the finest level first.
  std::vector<LevelSize> level_sizes() const;
  std::int64_t memory_bytes() const;

 private:
  struct Level;

  void gather_cells(std::size_t level);
  void sum_coarse_matrix(std::size_t level);
  void cycle(std::size_t level);
  void correct_from_below(std::size_t level);
  static void smooth_from_zero(Level& level, std::size_t i);
  void restrict_residual(Level& fine, Level& coarse);
  void correct_and_smooth(Level& fine, const Level& coarse);

  Box domain_;
  double cell_edge_m_;
  int threads_;
  int used_levels_ = 0;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<DirectSolver> coarsest_;
  std::vector<CoarseRow<Real>> row_sums_;  ///< one a thread
};

extern template class Multigrid<float>;
extern template class Multigrid<double>;

}  // namespace sluice::mps
