// A particle's neighbours as packs: consecutive ones, as many at a time as the machine's vectors hold.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solvers/cell_rows.h"
#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/pair_sums.h"

namespace sluice::wcsph {

/// Up to `width` consecutive neighbours.
struct PackOfRun {
  std::int32_t begin;
  std::int32_t count;
  std::int32_t writable;  ///< lanes that may be written: `count`, or all where what lies behind is free too
};

/// The packs of a particle's runs. They are listed first, so that the loop over pairs has one exit a particle instead
/// of one a run: four packs of every run are written without a branch, whether it has them or not; longer runs are
/// rare.
template <class Pack>
class PackList {
 public:
  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }

  /// Packs that are read only.
  void list(std::span<const Run> runs) {
    clear();
    for (const Run& run : runs) append(run, run.end);
  }
  /// Packs that may be written, each run's as far as the particle before its end in `ends`.
  void list(std::span<const Run> runs, std::span<const std::int32_t> ends) {
    clear();
    for (std::size_t k = 0; k < runs.size(); ++k) append(runs[k], ends[k]);
  }
  const PackOfRun* begin() const { return packs_.data(); }
  const PackOfRun* end() const { return packs_.data() + size_; }

 private:
  static constexpr std::int32_t width = Lanes<Pack>::width;
  static constexpr std::int32_t at_once = 4;

  static PackOfRun pack(const Run& run, std::int32_t begin, std::int32_t writable_end) {
    const std::int32_t count = std::min(width, run.end - begin);
    return {begin, count, begin + width <= writable_end ? width : count};
  }
  void append(const Run& run, std::int32_t writable_end) {
    if (packs_.size() < size_ + at_once) packs_.resize(2 * packs_.size());
    const std::int32_t length = run.end - run.begin;
    for (std::int32_t m = 0; m < at_once; ++m) {
      packs_[size_ + static_cast<std::size_t>(m)] = pack(run, run.begin + m * width, writable_end);
    }
    size_ += static_cast<std::size_t>(std::min(at_once, (length + width - 1) / width));
    if (length > at_once * width) append_rest(run, writable_end);
  }
  void append_rest(const Run& run, std::int32_t writable_end) {
    for (std::int32_t k = run.begin + at_once * width; k < run.end; k += width) {
      if (packs_.size() == size_) packs_.resize(2 * packs_.size());
      packs_[size_++] = pack(run, k, writable_end);
    }
  }

  std::vector<PackOfRun> packs_ = std::vector<PackOfRun>(64);
  std::size_t size_ = 0;
};

/// A pack of neighbours of one particle.
template <class Pack>
struct Pairs {
  Vec3<Pack> r;  ///< r_ij [quantum]
  Pack distance2;
  Pack taper;  ///< 1 - q/2; zero for lanes beyond the kernel's radius or the run's end
};

template <class Pack>
[[gnu::always_inline]] inline Pairs<Pack> pairs(const Vec3<typename Particles<Pack>::Coordinate>& i,
                                                const Particles<Pack>& neighbours, PackOfRun pack,
                                                const PairConstants<Pack>& c) {
  using L = Lanes<Pack>;
  const auto j = static_cast<std::size_t>(pack.begin);
  const auto& x = neighbours.coordinate;
  Pairs<Pack> p;
  p.r = {L::difference(&x.x[j], i.x), L::difference(&x.y[j], i.y), L::difference(&x.z[j], i.z)};
  p.distance2 = dot(p.r, p.r);
  p.taper = smaller(wendland_taper(square_root(p.distance2), c.half_per_h), L::first(pack.count));
  return p;
}

/// What a pack of neighbours brings to a sum.
template <class Pack>
struct Neighbours {
  Vec3<Pack> velocity;
  Pack density;
  Pack pressure;
  Pack sound;
  Pack volume;

  [[gnu::always_inline]] Neighbours(const Particles<Pack>& p, std::size_t j)
      : velocity{Lanes<Pack>::load(&p.velocity.x[j]), Lanes<Pack>::load(&p.velocity.y[j]),
                 Lanes<Pack>::load(&p.velocity.z[j])},
        density(Lanes<Pack>::load(&p.density[j])),
        pressure(Lanes<Pack>::load(&p.pressure[j])),
        sound(Lanes<Pack>::load(&p.sound[j])),
        volume(Lanes<Pack>::load(&p.volume[j])) {}
};

/// The particle whose sums are gathered.
template <class Pack>
struct Target {
  Vec3<typename Particles<Pack>::Coordinate> x;
  Vec3<Pack> velocity;
  Pack density;
  Pack density_and_twice_reference;
  Pack pressure;
  Pack sound;
  Pack volume;
  Pack inverse_density;

  Target(const Particles<Pack>& p, std::size_t i, const PairConstants<Pack>& c)
      : x{p.coordinate.x[i], p.coordinate.y[i], p.coordinate.z[i]},
        velocity(p.velocity.template at<Pack>(i)),
        density(p.density[i]),
        density_and_twice_reference(p.density[i] + 2 * c.reference_density),
        pressure(p.pressure[i]),
        sound(p.sound[i]),
        volume(p.volume[i]),
        inverse_density(p.volume[i] / c.mass) {}
};

}  // namespace sluice::wcsph
