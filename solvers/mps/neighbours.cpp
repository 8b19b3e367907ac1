#include "solvers/mps/neighbours.h"

#include <omp.h>

#include <algorithm>

#include "solvers/mps/terms.h"

namespace sluice::mps {
namespace {

constexpr std::size_t expected_row = 44;  // neighbours in a full lattice and a few more

}  // namespace

template <class Pack>
void NeighbourList<Pack>::list(Particles<Pack>& particles, const SearchSet& fluid, const SearchSet& walls,
                               const SearchSet& dummies, const Reach& reach, int threads) {
  const double cut = reach.list_radius_m / reach.quantum_m;
  const auto n = static_cast<std::int64_t>(particles.size());
  collectors_.resize(static_cast<std::size_t>(threads));
  dummies_.resize(particles.size());
  rows_.reserve(particles.size(), expected_row * (particles.fluid + particles.walls / 2));
  do {
    rows_.clear(particles.size());
#pragma omp parallel num_threads(threads)
    {
      Collector& c = collectors_[static_cast<std::size_t>(omp_get_thread_num())];
      typename SparseRows<Real>::Writer writer(rows_);
#pragma omp for schedule(dynamic, 256)
      for (std::int64_t k = static_cast<std::int64_t>(particles.first_wall()); k < n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const Vec3d x = particles.position.template at<double>(i);
        c.clear();
        if (particles.is_fluid(i) || fluid.index.any_near(x)) {
          c.add(particles, i, fluid, cut * cut);
          if (walls.index.any_near(x)) c.add(particles, i, walls, cut * cut);
        }
        const std::size_t with_pressure = c.count;
        if (with_pressure > 0 && dummies.index.any_near(x)) c.add(particles, i, dummies, cut * cut);
        list_row(particles, i, c, reach, writer, c.count - with_pressure);
      }
    }
  } while (rows_.grew_for_more());
}

template <class Pack>
void NeighbourList<Pack>::Collector::make_room(std::size_t wanted) {
  if (column.size() >= wanted) return;
  column.resize(2 * wanted);
  weight.resize(2 * wanted);
  place.resize(2 * wanted);
  for (auto& v : kept) v.resize(2 * wanted);
  for (auto& v : candidate) v.resize(2 * wanted);
}

/// Differences of whole runs in packs; then which are within reach, one by one without a branch; then those together.
template <class Pack>
void NeighbourList<Pack>::Collector::add(const Particles<Pack>& particles, std::size_t self, const SearchSet& set,
                                         double cut2) {
  using L = Lanes<Pack>;
  const auto& at = particles.coordinate;
  const auto limit = static_cast<Real>(cut2);
  std::size_t candidates = 0;
  const std::size_t before = count;
  for (const Run& run : set.index.neighbours(particles.position.template at<double>(self), 0.0)) {
    const auto first = set.first + static_cast<std::size_t>(run.begin);
    const auto length = static_cast<std::size_t>(run.end - run.begin);
    make_room(std::max(count, candidates) + length + L::width);
    for (std::size_t m = 0; m < length; m += L::width) {
      const Vec3<Pack> r{L::difference(&at.x[first + m], at.x[self]), L::difference(&at.y[first + m], at.y[self]),
                         L::difference(&at.z[first + m], at.z[self])};
      L::store(r.x, &candidate[0][candidates + m]);
      L::store(r.y, &candidate[1][candidates + m]);
      L::store(r.z, &candidate[2][candidates + m]);
      L::store(dot(r, r), &candidate[3][candidates + m]);
    }
    std::int32_t* const columns = column.data();
    std::int32_t* const places = place.data();
    const Real* const distance2 = candidate[3].data() + candidates;
    std::size_t k = count;
    for (std::size_t m = 0; m < length; ++m) {
      columns[k] = static_cast<std::int32_t>(first + m);
      places[k] = static_cast<std::int32_t>(candidates + m);
      k += static_cast<std::size_t>(distance2[m] < limit) & static_cast<std::size_t>(first + m != self);
    }
    count = k;
    candidates += length;
  }
  for (std::size_t part = 0; part < 4; ++part) {
    for (std::size_t k = before; k < count; ++k) kept[part][k] = candidate[part][static_cast<std::size_t>(place[k])];
  }
}

/// n_i = sum omega_ij   [1]   Eq. (17);   sigma_i = |sum r_ij omega_ij| / n_i   [m]   Eq. (30)
template <class Pack>
void NeighbourList<Pack>::list_row(Particles<Pack>& particles, std::size_t i, Collector& c, const Reach& reach,
                                   typename SparseRows<Real>::Writer& writer, std::size_t dummies) {
  using L = Lanes<Pack>;
  const Pack radius(static_cast<Real>(reach.effective_radius_m / reach.quantum_m));
  Pack weights{};
  Vec3<Pack> moment{};
  c.make_room(c.count + L::width);
  for (std::size_t m = 0; m < c.count; m += L::width) {
    const Pack lanes = L::first(static_cast<int>(std::min<std::size_t>(L::width, c.count - m)));
    const Pack distance = square_root(L::load(&c.kept[3][m]));
    const Pack omega = where_positive(lanes, weight(distance, radius));
    weights += omega;
    moment += omega * Vec3<Pack>{L::load(&c.kept[0][m]), L::load(&c.kept[1][m]), L::load(&c.kept[2][m])};
    L::store(omega, &c.weight[m]);
  }
  const Real n = lane_sum(weights);
  const Vec3<Real> sum{lane_sum(moment.x), lane_sum(moment.y), lane_sum(moment.z)};
  particles.number_density[i] = n;
  particles.centroid_offset[i] = n > 0 ? static_cast<Real>(reach.quantum_m) *
                                             static_cast<Real>(square_root(static_cast<double>(dot(sum, sum)))) / n
                                       : Real{};
  dummies_[i] = static_cast<std::uint16_t>(dummies);
  writer.write(i, c.column.data(), c.weight.data(), c.count);
}

template <class Pack>
std::int64_t NeighbourList<Pack>::memory_bytes() const {
  return rows_.memory_bytes() + bytes(dummies_);
}

template class NeighbourList<double>;
template class NeighbourList<FloatPack>;

}  // namespace sluice::mps
