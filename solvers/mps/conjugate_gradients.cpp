#include "solvers/mps/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

namespace sluice::mps {
namespace {

/// Rows of a block. Small, since rows of dry walls are empty and lie together: blocks go round the threads.
constexpr std::size_t block = 512;

}  // namespace

/// term(i) may also write element i of the work vectors: one pass for an update and a dot product.
template <class Real>
template <class Term>
double ConjugateGradients<Real>::sum(const PressureMatrix<Real>& A, Term&& term) {
  const auto blocks = static_cast<std::int64_t>((A.end - A.begin + block - 1) / block);
  partial_.resize(static_cast<std::size_t>(blocks));
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::size_t first = A.begin + static_cast<std::size_t>(b) * block;
    const std::size_t last = std::min(A.end, first + block);
    double s = 0;
    for (std::size_t i = first; i < last; ++i) s += term(i);
    partial_[static_cast<std::size_t>(b)] = s;
  }
  double total = 0;
  for (const double s : partial_) total += s;
  return total;
}

template <class Real>
Convergence ConjugateGradients<Real>::solve(const PressureMatrix<Real>& A, std::span<const double> b,
                                            std::span<double> x, const PreconditionerCall<Real>& precondition,
                                            double tolerance, int most_iterations) {
  for (auto* v : {&residual_, &product_}) v->resize(A.end);
  direction_.resize(A.end);
  history_.clear();
  double* const r = residual_.data();
  Real* const p = direction_.data();
  double* const q = product_.data();
  std::fill_n(p, A.begin, Real{});  // columns below the first row are never read, but let them be numbers
  const double norm_b = std::sqrt(sum(A, [&](std::size_t i) { return b[i] * b[i]; }));
  if (norm_b == 0) {
    std::fill(x.begin(), x.end(), 0.0);
    return {0, 0, true};
  }
  double norm_r = std::sqrt(sum(A, [&](std::size_t i) {
    r[i] = b[i] - product(A, i, x.data());
    return r[i] * r[i];
  }));
  history_.push_back(norm_r / norm_b);
  double rz_before = 0;
  for (int k = 0; k < most_iterations && norm_r > tolerance * norm_b; ++k) {
    const Real* const z = precondition(residual_).data();
    const double rz = sum(A, [&](std::size_t i) { return r[i] * static_cast<double>(z[i]); });
    const auto beta = static_cast<Real>(k == 0 ? 0 : rz / rz_before);
    sum(A, [&](std::size_t i) {
      p[i] = z[i] + (k == 0 ? Real{} : beta * p[i]);
      return 0.0;
    });
    const double pq = sum(A, [&](std::size_t i) {
      q[i] = product(A, i, p);
      return static_cast<double>(p[i]) * q[i];
    });
    const double alpha = rz / pq;
    norm_r = std::sqrt(sum(A, [&](std::size_t i) {
      x[i] += alpha * static_cast<double>(p[i]);
      r[i] -= alpha * q[i];
      return r[i] * r[i];
    }));
    rz_before = rz;
    history_.push_back(norm_r / norm_b);
  }
  return {static_cast<int>(history_.size()) - 1, norm_r / norm_b, norm_r <= tolerance * norm_b};
}

template <class Real>
std::int64_t ConjugateGradients<Real>::memory_bytes() const {
  return bytes(residual_) + bytes(direction_) + bytes(product_) + bytes(partial_);
}

template <class Real>
void jacobi(const PressureMatrix<Real>& A, std::span<const double> r, std::span<Real> z, int threads) {
  const auto n = static_cast<std::int64_t>(A.end);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (auto k = static_cast<std::int64_t>(A.begin); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    z[i] = A.has_row[i] != 0 ? static_cast<Real>(r[i]) / A.diagonal[i] : Real{};
  }
}

template class ConjugateGradients<float>;
template class ConjugateGradients<double>;
template void jacobi(const PressureMatrix<float>&, std::span<const double>, std::span<float>, int);
template void jacobi(const PressureMatrix<double>&, std::span<const double>, std::span<double>, int);

}  // namespace sluice::mps
