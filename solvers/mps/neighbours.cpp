#include "solvers/mps/neighbours.h"

#include <omp.h>

#include <algorithm>
#include <array>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

// Entries of the two rows for which room is made at first: a full lattice has 18 near and 14 far, disordered fluid
// more.
constexpr std::size_t expected_near = 23;
constexpr std::size_t expected_far = 30;

template <class Pack, class Real>
Real sum_of(const std::vector<Real>& values, std::size_t n) {
  using L = Lanes<Pack>;
  Pack sum{};
  for (std::size_t k = 0; k < n; k += L::width)
    sum += where_positive(L::first(static_cast<int>(std::min<std::size_t>(L::width, n - k))), L::load(&values[k]));
  return lane_sum(sum);
}

}  // namespace

template <class Pack>
void NeighbourList<Pack>::list(Particles<Pack>& particles, const SearchSet& fluid, const SearchSet& walls,
                               const SearchSet& dummies, const Reach& reach, int threads) {
  const auto n = static_cast<std::int64_t>(particles.size());
  collectors_.resize(static_cast<std::size_t>(threads));
  const auto least_near_weight = static_cast<Real>(reach.effective_radius_m / reach.near_radius_m - 1);
  dummies_.resize(particles.size());
  count_.resize(particles.size());
  near_weight_.resize(particles.size());
  far_weight_.resize(particles.size());
  near_.reserve(particles.size(), expected_near * (particles.fluid + particles.walls / 2));
  far_.reserve(particles.size(), expected_far * (particles.fluid + particles.walls / 2));
  do {
    near_.clear(particles.size());
    far_.clear(particles.size());
#pragma omp parallel num_threads(threads)
    {
      Collector& c = collectors_[static_cast<std::size_t>(omp_get_thread_num())];
      c.radius = Pack(static_cast<Real>(reach.effective_radius_m / reach.quantum_m));
      const double list_radius = reach.list_radius_m / reach.quantum_m;
      c.list_radius2 = static_cast<Real>(list_radius * list_radius);
      typename SparseRows<Real>::Writer near_writer(near_);
      typename SparseRows<Real>::Writer far_writer(far_);
#pragma omp for schedule(dynamic, 256)
      for (auto k = static_cast<std::int64_t>(particles.first_wall()); k < n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const Vec3d x = particles.position.template at<double>(i);
        c.clear();
        if (particles.is_fluid(i) || fluid.index.any_near(x)) {
          c.find(particles, i, fluid);
          if (walls.proximity->any_near(x)) c.find(particles, i, walls);
          c.weigh(particles, i, 0);
        }
        c.part_near(least_near_weight);
        near_writer.write(i, c.near_column.data(), c.near_weight.data(), c.near);
        const std::size_t with_pressure = c.count;
        near_weight_[i] = sum_of<Pack>(c.near_weight, c.near);
        far_weight_[i] = sum_of<Pack>(c.weight, c.count);
        if (c.near + c.count > 0 && dummies.proximity->any_near(x)) {
          c.find(particles, i, dummies);
          c.weigh(particles, i, with_pressure);
        }
        dummies_[i] = static_cast<std::uint16_t>(c.count - with_pressure);
        count_[i] = static_cast<std::uint16_t>(c.near + c.within());
        far_writer.write(i, c.column.data(), c.weight.data(), c.count, with_pressure);
        finish_sums(particles, i, c, reach.quantum_m);
      }
    }
  } while (static_cast<int>(near_.grew_for_more()) + static_cast<int>(far_.grew_for_more()) > 0);
}

template <class Pack>
void NeighbourList<Pack>::Collector::clear() {
  count = 0;
  weights = Pack{};
  moment = {};
}

template <class Pack>
void NeighbourList<Pack>::Collector::make_room(std::size_t wanted) {
  const std::size_t room = wanted + Lanes<Pack>::width;  // packs are read and written whole
  if (column.size() >= room) return;
  column.resize(2 * room);
  weight.resize(2 * room);
}

template <class Pack>
void NeighbourList<Pack>::Collector::part_near(Real least_weight) {
  near_column.resize(column.size());
  near_weight.resize(column.size());
  near = 0;
  std::size_t far = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = column[k];
    const Real omega = weight[k];
    near_column[near] = column[far] = j;
    near_weight[near] = weight[far] = omega;
    const bool is_near = omega > least_weight;
    near += is_near;
    far += !is_near;
  }
  count = far;
}

/// Distances of whole packs of candidates; then, lane by lane and without a branch, what is within reach is kept. The
/// particle itself is the one at distance zero.
template <class Pack>
void NeighbourList<Pack>::Collector::find(const Particles<Pack>& particles, std::size_t self, const SearchSet& set) {
  using L = Lanes<Pack>;
  const auto& at = particles.coordinate;
  std::array<std::int32_t, L::width> near;
  for (const Run& run : set.index.neighbours(particles.position.template at<double>(self), 0.0)) {
    const auto first = set.first + static_cast<std::size_t>(run.begin);
    const auto length = static_cast<std::size_t>(run.end - run.begin);
    make_room(count + length);
    std::int32_t* const columns = column.data();
    std::size_t kept = count;
    for (std::size_t m = 0; m < length; m += L::width) {
      const Vec3<Pack> r{L::difference(&at.x[first + m], at.x[self]), L::difference(&at.y[first + m], at.y[self]),
                         L::difference(&at.z[first + m], at.z[self])};
      L::store_between(dot(r, r), Real{}, list_radius2, near.data());
      const std::size_t lanes = std::min<std::size_t>(L::width, length - m);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        columns[kept] = static_cast<std::int32_t>(first + m + lane);
        kept += static_cast<std::size_t>(near[lane]);
      }
    }
    count = kept;
  }
}

/// Most candidates are out of reach: so roots and quotients are taken of what was kept.
template <class Pack>
void NeighbourList<Pack>::Collector::weigh(const Particles<Pack>& particles, std::size_t self, std::size_t begin) {
  using L = Lanes<Pack>;
  const auto& at = particles.coordinate;
  Pack sum = weights;  // local, or each pack would wait for the one before to reach memory
  Vec3<Pack> moments = moment;
  std::array<std::int32_t, L::width> to;
  for (std::size_t m = begin; m < count; m += L::width) {
    const auto n = static_cast<int>(std::min<std::size_t>(L::width, count - m));
    L::store(L::with_repeats(L::load(&column[m]), n), to.data());
    const Vec3<Pack> r{L::difference_at(at.x.data(), to.data(), at.x[self]),
                       L::difference_at(at.y.data(), to.data(), at.y[self]),
                       L::difference_at(at.z.data(), to.data(), at.z[self])};
    const Pack w = where_positive(L::first(n), mps::weight(square_root(dot(r, r)), radius));
    sum += w;
    moments += w * r;
    L::store(w, &weight[m]);
  }
  weights = sum;
  moment = moments;
}

/// What is listed beyond the effective radius has no weight.
template <class Pack>
std::size_t NeighbourList<Pack>::Collector::within() const {
  return static_cast<std::size_t>(
      std::count_if(weight.begin(), weight.begin() + static_cast<std::ptrdiff_t>(count), [](Real w) { return w > 0; }));
}

/// n_i = sum omega_ij   [1]   Eq. (17);   sigma_i = |sum r_ij omega_ij| / n_i   [m]   Eq. (30)
template <class Pack>
void NeighbourList<Pack>::finish_sums(Particles<Pack>& particles, std::size_t i, const Collector& c, double quantum_m) {
  const Real n = lane_sum(c.weights);
  const Vec3<Real> sum{lane_sum(c.moment.x), lane_sum(c.moment.y), lane_sum(c.moment.z)};
  particles.number_density[i] = n;
  particles.centroid_offset[i] =
      n > 0 ? static_cast<Real>(quantum_m) * static_cast<Real>(square_root(static_cast<double>(dot(sum, sum)))) / n
            : Real{};
}

template <class Pack>
std::int64_t NeighbourList<Pack>::memory_bytes() const {
  return near_.memory_bytes() + far_.memory_bytes() + bytes(dummies_) + bytes(count_) + bytes(near_weight_) +
         bytes(far_weight_);
}

template class NeighbourList<double>;
template class NeighbourList<FloatPack>;

}  // namespace sluice::mps
