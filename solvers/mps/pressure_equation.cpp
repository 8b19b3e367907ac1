#include "solvers/mps/pressure_equation.h"

#include <fmt/format.h>

#include <algorithm>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

/// With so few neighbours a particle is spray, whatever its centroid says.
constexpr std::uint32_t few_neighbours = 4;

/// n_i < beta_1 n0 and sigma_i > varrho_1 l0   Eqs. (28) and (29)
template <class Pack>
bool is_at_surface(const Particles<Pack>& p, const OperatorConstants& c, std::size_t i, std::uint32_t neighbours) {
  if (neighbours <= few_neighbours) return true;
  const auto n_i = static_cast<double>(p.number_density[i]);
  const auto sigma_i = static_cast<double>(p.centroid_offset[i]);
  const bool is_sparse = n_i < c.parameters.least_density_ratio * c.lattice.number_density;
  const bool is_lopsided = sigma_i > c.parameters.centroid_over_distance * c.parameters.particle_distance_m;
  return is_sparse && is_lopsided;
}

}  // namespace

template <class Pack>
PressureEquation<Pack>::PressureEquation(const OperatorConstants& constants, double near_radius_m, const Box& domain_m,
                                         int threads)
    : c_(constants),
      threads_(threads),
      multigrid_(domain_m, std::max(2 * constants.parameters.particle_distance_m, near_radius_m), threads),
      conjugate_gradients_(threads) {}

/// Eq. (23) times -lambda0 n0 / (2 dim).
template <class Pack>
void PressureEquation<Pack>::assemble(const Particles<Pack>& p, const NeighbourList<Pack>& list) {
  const auto& parameters = c_.parameters;
  const double scale = c_.lattice.lambda_m2 * c_.lattice.number_density / 6;
  const double rho_per_dt2 = parameters.density_kg_m3 / (c_.dt_s * c_.dt_s);
  const double compressibility = rho_per_dt2 * parameters.kappa_c_m_s2_kg * scale;
  const double source = rho_per_dt2 * scale;
  const double kappa_r = parameters.kappa_r;
  // Near neighbours make up for those left out.
  const auto near_factor = static_cast<Real>(1 / c_.lattice.near_share);
  const double n0 = c_.lattice.number_density;
  far_.resize(p.size());
  diagonal_.resize(p.size());
  near_diagonal_.resize(p.size());
  has_row_.assign(p.size(), 0);
  right_side_.resize(p.size());
  const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for num_threads(threads_) schedule(static, 512)
  for (auto k = static_cast<std::int64_t>(p.first_wall()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool has_row = !is_at_surface(p, c_, i, list.count(i));
    far_[i] = list.far_with_pressure(i);
    has_row_[i] = has_row ? 1 : 0;
    const double crowding = (static_cast<double>(p.number_density[i]) - n0) / n0;
    right_side_[i] = has_row ? source * relaxation(crowding, kappa_r, parameters.tolerated_crowding) * crowding : 0.0;
    const auto c = static_cast<Real>(compressibility);
    diagonal_[i] = c + list.near_weight(i) + list.far_weight(i);
    near_diagonal_[i] = c + near_factor * list.near_weight(i);
  }
  matrix_ = {{list.near().spans(), list.near().columns(), list.near().values()},
             {far_, list.far().columns(), list.far().values()},
             diagonal_,
             near_diagonal_,
             near_factor,
             has_row_,
             p.first_wall(),
             p.size()};
}

template <class Pack>
PressureReport PressureEquation<Pack>::solve(Particles<Pack>& p, const NeighbourList<Pack>& list) {
  assemble(p, list);
  PressureReport report;
  const bool multigrid = c_.parameters.preconditioner == Preconditioner::multigrid;
  if (multigrid) multigrid_.prepare(matrix_, p.position.x, p.position.y, p.position.z);
  if (!multigrid) jacobi_.resize(p.size());
  const auto precondition = [&](std::span<const double> r) -> std::span<const Real> {
    if (multigrid) return multigrid_.apply(r);
    jacobi(matrix_, r, std::span(jacobi_), threads_);
    return jacobi_;
  };
  std::int64_t unknowns = 0;
  const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(+ : unknowns)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (has_row_[i] == 0) p.pressure[i] = 0;
    unknowns += has_row_[i];
  }
  report.unknowns = unknowns;
  report.convergence = conjugate_gradients_.solve(matrix_, right_side_, p.pressure, precondition,
                                                  c_.parameters.tolerance, c_.parameters.most_iterations);
  if (!report.convergence.converged) {
    throw NotConverged(fmt::format(
        "the pressure equation ({} unknowns) did not converge: relative residual {:.2e} after {} iterations, {:.0e} "
        "wanted; try a smaller courant or more iterations",
        report.unknowns, report.convergence.relative_residual, report.convergence.iterations, c_.parameters.tolerance));
  }
  std::int64_t set_to_zero = 0;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(+ : set_to_zero)
  for (std::int64_t k = 0; k < n; ++k) {
    double& pressure = p.pressure[static_cast<std::size_t>(k)];
    set_to_zero += pressure < 0;
    pressure = std::max(0.0, pressure);
  }
  report.set_to_zero = set_to_zero;
  return report;
}

template <class Pack>
std::int64_t PressureEquation<Pack>::memory_bytes() const {
  return multigrid_.memory_bytes() + conjugate_gradients_.memory_bytes() + bytes(far_) + bytes(diagonal_) +
         bytes(near_diagonal_) + bytes(jacobi_) + bytes(has_row_) + bytes(right_side_);
}

template class PressureEquation<double>;
template class PressureEquation<FloatPack>;

}  // namespace sluice::mps
