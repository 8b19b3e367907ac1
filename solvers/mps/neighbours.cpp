#include "solvers/mps/neighbours.h"

#include <omp.h>

#include <algorithm>
#include <array>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

constexpr std::size_t expected_near = 26;
constexpr std::size_t expected_row = 44;  // neighbours in a full lattice and a few more

}  // namespace

template <class Pack>
void NeighbourList<Pack>::list(Particles<Pack>& particles, const SearchSet& fluid, const SearchSet& walls,
                               const SearchSet& dummies, const Reach& reach, int threads) {
  const auto n = static_cast<std::int64_t>(particles.size());
  collectors_.resize(static_cast<std::size_t>(threads));
  const auto least_near_weight = static_cast<Real>(reach.effective_radius_m / reach.near_radius_m - 1);
  near_.reserve(particles.size(), expected_near * (particles.fluid + particles.walls / 2));
  dummies_.resize(particles.size());
  rows_.reserve(particles.size(), expected_row * (particles.fluid + particles.walls / 2));
  do {
    rows_.clear(particles.size());
    near_.clear(particles.size());
#pragma omp parallel num_threads(threads)
    {
      Collector& c = collectors_[static_cast<std::size_t>(omp_get_thread_num())];
      c.radius = Pack(static_cast<Real>(reach.effective_radius_m / reach.quantum_m));
      const double list_radius = reach.list_radius_m / reach.quantum_m;
      c.list_radius2 = static_cast<Real>(list_radius * list_radius);
      typename SparseRows<Real>::Writer writer(rows_);
      typename SparseRows<Real>::Writer near_writer(near_);
#pragma omp for schedule(dynamic, 256)
      for (auto k = static_cast<std::int64_t>(particles.first_wall()); k < n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const Vec3d x = particles.position.template at<double>(i);
        c.clear();
        if (particles.is_fluid(i) || fluid.index.any_near(x)) {
          c.add(particles, i, fluid);
          if (walls.proximity->any_near(x)) c.add(particles, i, walls);
        }
        const std::size_t with_pressure = c.count;
        c.pick_near(least_near_weight);
        near_writer.write(i, c.near_column.data(), c.near_weight.data(), c.near);
        if (with_pressure > 0 && dummies.proximity->any_near(x)) c.add(particles, i, dummies);
        finish_row(particles, i, c, reach.quantum_m, writer, c.count - with_pressure);
      }
    }
  } while (static_cast<int>(rows_.grew_for_more()) + static_cast<int>(near_.grew_for_more()) > 0);
}

template <class Pack>
void NeighbourList<Pack>::Collector::clear() {
  count = 0;
  weights = Pack{};
  moment = {};
}

template <class Pack>
void NeighbourList<Pack>::Collector::make_room(std::size_t wanted) {
  if (column.size() >= wanted) return;
  column.resize(2 * wanted);
  weight.resize(2 * wanted);
}

template <class Pack>
void NeighbourList<Pack>::Collector::pick_near(Real least_weight) {
  near_column.resize(column.size());
  near_weight.resize(column.size());
  near = 0;
  for (std::size_t k = 0; k < count; ++k) {
    near_column[near] = column[k];
    near_weight[near] = weight[k];
    near += weight[k] > least_weight;
  }
}

/// Weights and sums of whole packs of candidates; then, lane by lane and without a branch, what is within reach is
/// kept. The particle itself is the one at distance zero.
template <class Pack>
void NeighbourList<Pack>::Collector::add(const Particles<Pack>& particles, std::size_t self, const SearchSet& set) {
  using L = Lanes<Pack>;
  const auto& at = particles.coordinate;
  Pack sum = weights;  // local, or each pack would wait for the one before to reach memory
  Vec3<Pack> moments = moment;
  std::array<std::int32_t, L::width> near;
  std::array<Real, L::width> omega;
  for (const Run& run : set.index.neighbours(particles.position.template at<double>(self), 0.0)) {
    const auto first = set.first + static_cast<std::size_t>(run.begin);
    const auto length = static_cast<std::size_t>(run.end - run.begin);
    make_room(count + length + L::width);
    for (std::size_t m = 0; m < length; m += L::width) {
      const Vec3<Pack> r{L::difference(&at.x[first + m], at.x[self]), L::difference(&at.y[first + m], at.y[self]),
                         L::difference(&at.z[first + m], at.z[self])};
      const Pack lanes = L::first(static_cast<int>(std::min<std::size_t>(L::width, length - m)));
      const Pack r2 = where_positive(lanes, dot(r, r));
      const Pack w = where_positive(r2, mps::weight(square_root(r2), radius));
      sum += w;
      moments += w * r;
      L::store_between(r2, Real{}, list_radius2, near.data());
      L::store(w, omega.data());
      std::int32_t* const columns = column.data() + count;
      Real* const row_weights = weight.data() + count;
      std::size_t kept = 0;
      for (std::size_t lane = 0; lane < L::width; ++lane) {
        columns[kept] = static_cast<std::int32_t>(first + m + lane);
        row_weights[kept] = omega[lane];
        kept += static_cast<std::size_t>(near[lane]);
      }
      count += kept;
    }
  }
  weights = sum;
  moment = moments;
}

/// n_i = sum omega_ij   [1]   Eq. (17);   sigma_i = |sum r_ij omega_ij| / n_i   [m]   Eq. (30)
template <class Pack>
void NeighbourList<Pack>::finish_row(Particles<Pack>& particles, std::size_t i, const Collector& c, double quantum_m,
                                     typename SparseRows<Real>::Writer& writer, std::size_t dummies) {
  const Real n = lane_sum(c.weights);
  const Vec3<Real> sum{lane_sum(c.moment.x), lane_sum(c.moment.y), lane_sum(c.moment.z)};
  particles.number_density[i] = n;
  particles.centroid_offset[i] =
      n > 0 ? static_cast<Real>(quantum_m) * static_cast<Real>(square_root(static_cast<double>(dot(sum, sum)))) / n
            : Real{};
  dummies_[i] = static_cast<std::uint16_t>(dummies);
  writer.write(i, c.column.data(), c.weight.data(), c.count);
}

template <class Pack>
std::int64_t NeighbourList<Pack>::memory_bytes() const {
  return rows_.memory_bytes() + near_.memory_bytes() + bytes(dummies_);
}

template class NeighbourList<double>;
template class NeighbourList<FloatPack>;

}  // namespace sluice::mps
