#include "solvers/mps/direct_solver.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <stdexcept>

namespace sluice::mps {

struct DirectSolver::Factor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* right_side = nullptr;
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;
  std::vector<std::int32_t> row_of;  ///< compact number by index, -1 where there is no row
  std::vector<int> column_start;
  std::vector<int> row_index;
  std::vector<double> value;
  std::size_t unknowns = 0;

  Factor() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;  // L L^T: the other form, L D L^T, takes negative pivots
    common.print = 0;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    for (cholmod_dense** d : {&right_side, &solution, &work_y, &work_e}) cholmod_free_dense(d, &common);
    cholmod_finish(&common);
  }

  template <class Real>
  void take_upper_triangle(const PressureMatrix<Real>& A);
};

DirectSolver::DirectSolver() : factor_(std::make_unique<Factor>()) {}
DirectSolver::~DirectSolver() = default;

/// A column an unknown.
template <class Real>
void DirectSolver::Factor::take_upper_triangle(const PressureMatrix<Real>& A) {
  row_of.assign(A.end, -1);
  unknowns = 0;
  for (std::size_t i = A.begin; i < A.end; ++i)
    if (A.has_row[i] != 0) row_of[i] = static_cast<std::int32_t>(unknowns++);
  column_start.assign(1, 0);
  row_index.clear();
  value.clear();
  for (std::size_t i = A.begin; i < A.end; ++i) {
    if (row_of[i] < 0) continue;
    row_index.push_back(row_of[i]);
    value.push_back(static_cast<double>(A.diagonal[i]));
    const auto add = [&](const Entries<Real>& entries) {
      for (std::uint32_t k = entries.rows[i].begin; k < entries.rows[i].end; ++k) {
        const std::int32_t row = row_of[static_cast<std::size_t>(entries.columns[k])];
        if (row < 0 || row >= row_of[i]) continue;
        row_index.push_back(row);
        value.push_back(-static_cast<double>(entries.weights[k]));
      }
    };
    add(A.near);
    if (A.has_far()) add(A.far);
    column_start.push_back(static_cast<int>(row_index.size()));
  }
}

template <class Real>
void DirectSolver::factorise(const PressureMatrix<Real>& A) {
  Factor& f = *factor_;
  f.take_upper_triangle(A);
  if (f.unknowns == 0) return;
  cholmod_sparse m{};
  m.nrow = m.ncol = f.unknowns;
  m.nzmax = f.value.size();
  m.p = f.column_start.data();
  m.i = f.row_index.data();
  m.x = f.value.data();
  m.stype = 1;
  m.itype = CHOLMOD_INT;
  m.xtype = CHOLMOD_REAL;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = 0;
  m.packed = 1;
  cholmod_free_factor(&f.factor, &f.common);
  f.factor = cholmod_analyze(&m, &f.common);
  if (f.factor == nullptr || cholmod_factorize(&m, f.factor, &f.common) == 0 || f.common.status != CHOLMOD_OK) {
    throw std::runtime_error("the pressure matrix could not be factorised: it is not positive definite");
  }
  cholmod_free_dense(&f.right_side, &f.common);
  f.right_side = cholmod_zeros(f.unknowns, 1, CHOLMOD_REAL, &f.common);
}

template <class Real>
void DirectSolver::solve(std::span<const Real> b, std::span<Real> x) {
  Factor& f = *factor_;
  std::fill(x.begin(), x.end(), Real{});
  if (f.unknowns == 0) return;
  auto* right = static_cast<double*>(f.right_side->x);
  for (std::size_t i = 0; i < f.row_of.size(); ++i)
    if (f.row_of[i] >= 0) right[f.row_of[i]] = static_cast<double>(b[i]);
  if (cholmod_solve2(CHOLMOD_A, f.factor, f.right_side, nullptr, &f.solution, nullptr, &f.work_y, &f.work_e,
                     &f.common) == 0) {
    throw std::runtime_error("CHOLMOD could not solve the coarsest level");
  }
  const auto* solution = static_cast<const double*>(f.solution->x);
  for (std::size_t i = 0; i < f.row_of.size(); ++i)
    if (f.row_of[i] >= 0) x[i] = static_cast<Real>(solution[f.row_of[i]]);
}

template void DirectSolver::factorise(const PressureMatrix<float>&);
template void DirectSolver::factorise(const PressureMatrix<double>&);
template void DirectSolver::solve(std::span<const float>, std::span<float>);
template void DirectSolver::solve(std::span<const double>, std::span<double>);

}  // namespace sluice::mps
