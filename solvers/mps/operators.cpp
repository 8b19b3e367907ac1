#include "solvers/mps/operators.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

/// The correction matrix is used while its determinant is at least this share of the full lattice's. The flat surface
/// of a half-filled neighbourhood has about 0.1.
constexpr double least_determinant = 0.01;

/// Calls visit(columns, weights, how many) for each pack of a particle's near neighbours and of a part of its far ones;
/// one pack takes the end of the former and the begin of the latter. Columns are whole packs, what is too many repeats.
template <class Pack, class Visit>
[[gnu::always_inline]] inline void for_packs(const NeighbourList<Pack>& list, std::size_t i, Span far, Visit&& visit) {
  using L = Lanes<Pack>;
  constexpr std::uint32_t width = L::width;
  const auto& near_rows = list.near();
  const auto& far_rows = list.far();
  Span near = near_rows.span(i);
  for (; near.begin + width <= near.end; near.begin += width)
    visit(near_rows.columns() + near.begin, L::load(near_rows.values() + near.begin), static_cast<int>(width));
  while (near.begin < near.end || far.begin < far.end) {
    const std::uint32_t before = near.end - near.begin;
    const std::uint32_t n = std::min(width, before + (far.end - far.begin));
    const auto first = static_cast<int>(before);
    std::array<std::int32_t, width> columns;
    L::store(L::with_repeats(L::joined(near_rows.columns() + near.begin, first, far_rows.columns() + far.begin),
                             static_cast<int>(n)),
             columns.data());
    visit(columns.data(), L::joined(near_rows.values() + near.begin, first, far_rows.values() + far.begin),
          static_cast<int>(n));
    near.begin = near.end;
    far.begin += n - before;
  }
}

/// r_ij of a pack of entries [quantum].
template <class Pack>
[[gnu::always_inline]] inline Vec3<Pack> differences(const Particles<Pack>& p, std::size_t i,
                                                     const std::int32_t* columns) {
  using L = Lanes<Pack>;
  const auto& x = p.coordinate;
  return {L::difference_at(x.x.data(), columns, x.x[i]), L::difference_at(x.y.data(), columns, x.y[i]),
          L::difference_at(x.z.data(), columns, x.z[i])};
}

template <class Pack, class Real>
[[gnu::always_inline]] inline Vec3<Pack> gathered(const VectorField<Real>& field, const std::int32_t* columns) {
  using L = Lanes<Pack>;
  return {L::gather(field.x.data(), columns), L::gather(field.y.data(), columns), L::gather(field.z.data(), columns)};
}

/// Of the least pressure so far, the particle's own to begin with, and those of the neighbours in a part of a row. What
/// is listed beyond the effective radius, or fills the row up, has no weight and does not count.
template <class Real>
double least_pressure(const std::vector<double>& pressure, const SparseRows<Real>& rows, Span span, double so_far) {
  std::array<double, row_unit> least{};
  least.fill(so_far);
  for (std::uint32_t k = span.begin; k < span.end; k += row_unit)
    for (std::uint32_t m = 0; m < row_unit; ++m) {
      const double p = pressure[static_cast<std::size_t>(rows.columns()[k + m])];
      least[m] = std::min(least[m], rows.values()[k + m] > 0 ? p : so_far);
    }
  return *std::min_element(least.begin(), least.end());
}

template <class Pack>
Vec3d lane_sums(const Vec3<Pack>& v) {
  return {lane_sum(v.x), lane_sum(v.y), lane_sum(v.z)};
}

template <class Pack>
Symmetric3<double> lane_sums(const Symmetric3<Pack>& m) {
  return {lane_sum(m.xx), lane_sum(m.yy), lane_sum(m.zz), lane_sum(m.xy), lane_sum(m.xz), lane_sum(m.yz)};
}

}  // namespace

template <class Pack>
void predict_velocities(const Particles<Pack>& p, const NeighbourList<Pack>& list, const OperatorConstants& c,
                        VectorField<typename Lanes<Pack>::Real>& predicted, int threads) {
  using L = Lanes<Pack>;
  using Real = typename L::Real;
  const Pack radius(static_cast<Real>(c.parameters.effective_radius_m() / c.quantum_m));
  const double scale = c.parameters.viscosity_m2_s * 6 / (c.lattice.lambda_m2 * c.lattice.number_density);
  const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (auto k = static_cast<std::int64_t>(p.first_fluid()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto u = p.velocity.template at<Pack>(i);
    Vec3<Pack> laplacian{};
    for_packs<Pack>(list, i, list.far().span(i), [&](const std::int32_t* columns, const Pack&, int lanes) {
      const Vec3<Pack> r = differences(p, i, columns);
      const Pack omega = where_positive(L::first(lanes), weight(square_root(dot(r, r)), radius));
      const auto uj = gathered<Pack>(p.velocity, columns);
      laplacian += Vec3<Pack>{laplacian_term(u.x, uj.x, omega), laplacian_term(u.y, uj.y, omega),
                              laplacian_term(u.z, uj.z, omega)};
    });
    const Vec3d rate = scale * lane_sums(laplacian) + c.parameters.gravity_m_s2;
    predicted.set(i, p.velocity.template at<double>(i) + c.dt_s * rate);
  }
}

template <class Pack>
Vec3d pressure_gradient(const Particles<Pack>& p, const NeighbourList<Pack>& list, const OperatorConstants& c,
                        std::size_t i, bool& plain) {
  using L = Lanes<Pack>;
  using Real = typename L::Real;
  const Span far = list.far_with_pressure(i);
  const double least = least_pressure(p.pressure, list.near(), list.near().span(i), p.pressure[i]);
  const Pack reference(static_cast<Real>(least_pressure(p.pressure, list.far(), far, least)));
  Vec3<Pack> sum{};
  Symmetric3<Pack> matrix{};
  for_packs<Pack>(list, i, far, [&](const std::int32_t* columns, const Pack& weights, int lanes) {
    const Vec3<Pack> r = differences(p, i, columns);
    const Pack omega = where_positive(L::first(lanes), weights);
    const Pack distance2 = dot(r, r);
    sum += gradient_term(reference, L::gather(p.pressure.data(), columns), r, distance2, omega);
    matrix += correction_term(r, distance2, omega);
  });
  const double n0 = c.lattice.number_density;
  const Vec3d v = (1 / c.quantum_m) * lane_sums(sum);
  Vec3d gradient;
  plain = !solve(lane_sums(matrix), v, n0 / 3, least_determinant, gradient);
  return plain ? (3 / n0) * v : gradient;
}

template <class Pack>
CorrectionReport correct(Particles<Pack>& p, const NeighbourList<Pack>& list, const OperatorConstants& c, int threads) {
  const auto n = static_cast<std::int64_t>(p.size());
  std::int64_t plain_gradients = 0;
  double greatest = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(+ : plain_gradients) reduction(max : greatest)
  for (auto k = static_cast<std::int64_t>(p.first_fluid()); k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    bool plain = false;
    const Vec3d du = (-c.dt_s / c.parameters.density_kg_m3) * pressure_gradient(p, list, c, i, plain);
    p.velocity.set(i, p.velocity.template at<double>(i) + du);
    p.position.set(i, p.position.template at<double>(i) + c.dt_s * du);
    plain_gradients += plain;
    greatest = std::max(greatest, c.dt_s * std::sqrt(dot(du, du)));
  }
  return {plain_gradients, greatest};
}

template void predict_velocities(const Particles<double>&, const NeighbourList<double>&, const OperatorConstants&,
                                 VectorField<double>&, int);
template void predict_velocities(const Particles<FloatPack>&, const NeighbourList<FloatPack>&, const OperatorConstants&,
                                 VectorField<float>&, int);
template CorrectionReport correct(Particles<double>&, const NeighbourList<double>&, const OperatorConstants&, int);
template CorrectionReport correct(Particles<FloatPack>&, const NeighbourList<FloatPack>&, const OperatorConstants&,
                                  int);
template Vec3d pressure_gradient(const Particles<double>&, const NeighbourList<double>&, const OperatorConstants&,
                                 std::size_t, bool&);
template Vec3d pressure_gradient(const Particles<FloatPack>&, const NeighbourList<FloatPack>&, const OperatorConstants&,
                                 std::size_t, bool&);

}  // namespace sluice::mps
