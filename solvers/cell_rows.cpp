#include "solvers/cell_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/counting_sort.h"
#include "solvers/lanes.h"
#include "solvers/state_archive.h"

namespace sluice {

RowGeometry::RowGeometry(const Box& domain_m, double radius, double slack, double slice)
    : domain(domain_m),
      radius_m(radius),
      slack_m(slack),
      edge_m((radius + 2 * slack) / reach_rows),
      slice_m(slice),
      rows_per_m(1 / edge_m),
      slices_per_m(1 / slice_m) {
  // In the words of row_y() and slice(), so that rounding puts no point of the domain beyond the last of them.
  const auto cells = [](double length, double per_m) { return std::floor(length * per_m) + 1; };
  const double x = cells(domain.upper.x - domain.lower.x, slices_per_m);
  const double y = cells(domain.upper.y - domain.lower.y, rows_per_m) + 2 * reach_rows;
  const double z = cells(domain.upper.z - domain.lower.z, rows_per_m) + 2 * reach_rows;
  if (!(x * y * z < 2e9)) {
    throw std::invalid_argument(
        fmt::format("the domain has {:.3g} search slices, too many to index: choose a larger l0", x * y * z));
  }
  nx = static_cast<std::int32_t>(x);
  ny = static_cast<std::int32_t>(y);
  nz = static_cast<std::int32_t>(z);
}

RowIndex::RowIndex(const RowGeometry& geometry)
    : geometry_(geometry), stencil_(stencil(geometry)), row_start_(static_cast<std::size_t>(geometry.rows()) + 1) {
  start_.resize(at(geometry.rows(), 0));
}

void RowIndex::sort(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                    std::span<const std::uint8_t> leaves, int threads) {
  sort_into_rows(y, z, leaves, threads);
  order_.resize(by_row_.size());
#pragma omp parallel num_threads(threads)
  {
    std::vector<std::int32_t> scratch;
#pragma omp for schedule(dynamic, 8)
    for (std::int32_t r = 0; r < geometry_.rows(); ++r) sort_row_into_slices(r, x, scratch);
  }
}

void RowIndex::sort_into_rows(std::span<const double> y, std::span<const double> z,
                              std::span<const std::uint8_t> leaves, int threads) {
  const auto row_of = [&](std::int64_t i) -> std::int64_t {
    const auto k = static_cast<std::size_t>(i);
    return leaves.empty() || leaves[k] == 0 ? geometry_.row(y[k], z[k]) : -1;
  };
  counting_sort(0, static_cast<std::int64_t>(y.size()), static_cast<std::size_t>(geometry_.rows()), threads, row_of,
                row_start_, by_row_);
}

void RowIndex::sort_row_into_slices(std::int32_t row, std::span<const double> x, std::vector<std::int32_t>& scratch) {
  const auto first = static_cast<std::size_t>(row_start_[static_cast<std::size_t>(row)]);
  const auto last = static_cast<std::size_t>(row_start_[static_cast<std::size_t>(row) + 1]);
  const auto nx = static_cast<std::size_t>(geometry_.nx);
  std::int32_t* start = &start_[at(row, 0)];
  std::fill(start, start + nx + 1, static_cast<std::int32_t>(first));
  if (first == last) return;
  scratch.assign(nx, 0);
  const auto slice = [&](std::size_t k) {
    return static_cast<std::size_t>(geometry_.slice(x[static_cast<std::size_t>(by_row_[k])]));
  };
  for (std::size_t k = first; k < last; ++k) ++scratch[slice(k)];
  for (std::size_t s = 0; s < nx; ++s) {
    start[s + 1] = start[s] + scratch[s];
    scratch[s] = start[s];
  }
  for (std::size_t k = first; k < last; ++k) order_[static_cast<std::size_t>(scratch[slice(k)]++)] = by_row_[k];
}

void RowIndex::visit_state(StateArchive& archive, const std::string& name, std::size_t n) {
  order_.resize(n);
  archive.values(name + "_order", std::span(order_));
  archive.values(name + "_start", std::span(start_));
}

RowIndex::Stencil RowIndex::stencil(const RowGeometry& g) {
  Stencil s;
  s.y_offset.fill(1 + 2 * static_cast<float>(g.radius_m + g.edge_m));
  const auto edge = static_cast<float>(g.edge_m);
  // To the lower side of rows further on, to the upper side of rows before.
  const auto offset = [&](std::int32_t rows) {
    return edge * static_cast<float>(rows > 0 ? rows : rows < 0 ? -rows - 1 : 0);
  };
  const auto slope = [](std::int32_t rows) { return static_cast<float>(rows > 0 ? -1 : rows < 0 ? 1 : 0); };
  std::size_t next_forward = 0;
  std::size_t next_backward = std::tuple_size_v<ForwardRuns>;
  constexpr std::int32_t far = reach_rows;
  for (std::int32_t y = -far; y <= far; ++y) {
    for (std::int32_t z = -far; z <= far; ++z) {
      const std::size_t k = y > 0 || (y == 0 && z >= 0) ? next_forward++ : next_backward++;
      s.y_offset[k] = offset(y);
      s.z_offset[k] = offset(z);
      s.y_slope[k] = slope(y);
      s.z_slope[k] = slope(z);
      s.base[k] = g.row_at(y, z) * (g.nx + 1);
    }
  }
  s.per_slice = static_cast<float>(1.0 / g.slice_m);
  s.radius2 = static_cast<float>(g.radius_m * g.radius_m);
  return s;
}

RowIndex::Row RowIndex::row_search(std::int32_t row_y, std::int32_t row_z) const {
  const RowGeometry& g = geometry_;
  return {g.domain.lower.y + (row_y - reach_rows) * g.edge_m, g.domain.lower.z + (row_z - reach_rows) * g.edge_m,
          &start_[at(g.row_at(row_y, row_z), 0)]};
}

/// All rows at once: the chord that the kernel's sphere cuts out of each gives the slices to visit.
template <std::size_t N>
[[gnu::always_inline]] inline std::array<Run, N> RowIndex::find_runs(const Vec3d& point, const Row& row,
                                                                     double travel_m) const {
  using Integers = Lanes<FloatPack>::Integers;
  const auto y = static_cast<float>(point.y - row.y_m);
  const auto z = static_cast<float>(point.z - row.z_m);
  const auto x = static_cast<float>(point.x - geometry_.domain.lower.x) * stencil_.per_slice;
  const auto travel = static_cast<float>(travel_m);
  const float rounding_slices = 0.001F;
  std::array<std::int32_t, Stencil::lanes> low;
  std::array<std::int32_t, Stencil::lanes> high;
  for (std::size_t k = 0; k < N; k += FloatPack::size()) {
    const auto load = [&](const auto& values) { return FloatPack(&values[k], stdx::element_aligned); };
    const FloatPack dy = larger(load(stencil_.y_offset) + load(stencil_.y_slope) * y - travel, FloatPack(0));
    const FloatPack dz = larger(load(stencil_.z_offset) + load(stencil_.z_slope) * z - travel, FloatPack(0));
    const FloatPack chord2 = stencil_.radius2 - dy * dy - dz * dz;
    const FloatPack reach = square_root(larger(chord2, FloatPack(0))) * stencil_.per_slice +
                            (travel * stencil_.per_slice + rounding_slices);
    const Integers base(&stencil_.base[k], stdx::element_aligned);
    const FloatPack first = larger(x - reach, FloatPack(0));
    FloatPack last = smaller(x + reach, FloatPack(static_cast<float>(geometry_.nx - 1))) + 1.0F;
    stdx::where(chord2 <= 0.0F, last) = first;
    (base + stdx::static_simd_cast<Integers>(first)).copy_to(&low[k], stdx::element_aligned);
    (base + stdx::static_simd_cast<Integers>(last)).copy_to(&high[k], stdx::element_aligned);
  }
  std::array<Run, N> runs;
  for (std::size_t r = 0; r < N; ++r) runs[r] = {row.start[low[r]], row.start[high[r]]};
  return runs;
}

Runs RowIndex::neighbours(const Vec3d& point, const Row& row, double travel_m) const {
  return find_runs<rows_around>(point, row, travel_m);
}

ForwardRuns RowIndex::forward(const Vec3d& point, const Row& row, double travel_m) const {
  return find_runs<std::tuple_size_v<ForwardRuns>>(point, row, travel_m);
}

bool RowIndex::any_near(const Vec3d& point) const {
  const RowGeometry& g = geometry_;
  const std::int32_t jy = g.row_y(point.y);
  const std::int32_t jz = g.row_z(point.z);
  const double x0 = point.x - g.domain.lower.x;
  const double reach = g.radius_m + g.slack_m;
  const auto low = std::max(0, static_cast<std::int32_t>((x0 - reach) * g.slices_per_m));
  const auto high = std::min(g.nx - 1, static_cast<std::int32_t>((x0 + reach) * g.slices_per_m));
  for (std::int32_t z = jz - reach_rows; z <= jz + reach_rows; ++z) {
    for (std::int32_t y = jy - reach_rows; y <= jy + reach_rows; ++y) {
      const std::int32_t row = g.row_at(y, z);
      if (start_[at(row, low)] < start_[at(row, high + 1)]) return true;
    }
  }
  return false;
}

std::int64_t RowIndex::memory_bytes() const {
  return bytes(order_) + bytes(by_row_) + bytes(row_start_) + bytes(start_);
}

Proximity::Proximity(const RowIndex& index) : geometry_(index.geometry()) {
  const RowGeometry& g = geometry_;
  near_.resize(static_cast<std::size_t>(g.rows()) * static_cast<std::size_t>(g.nx), 0);
  const auto reach = static_cast<std::int32_t>((g.radius_m + g.slack_m) / g.slice_m) + 1;
  std::vector<std::uint8_t> in_reach(static_cast<std::size_t>(g.nx));
  for (std::int32_t row = 0; row < g.rows(); ++row) {
    // Slices that lie within reach of a particle of this row, then the rows around it.
    std::fill(in_reach.begin(), in_reach.end(), std::uint8_t{0});
    bool any = false;
    for (std::int32_t s = 0; s < g.nx; ++s) {
      const Run here = index.slices(row, s, s + 1);
      if (here.begin == here.end) continue;
      any = true;
      std::fill(in_reach.begin() + std::max(0, s - reach), in_reach.begin() + std::min(g.nx, s + reach + 1),
                std::uint8_t{1});
    }
    if (!any) continue;
    constexpr std::int32_t far = reach_rows;
    for (std::int32_t z = -far; z <= far; ++z) {
      for (std::int32_t y = -far; y <= far; ++y) {
        const std::int32_t other = row + g.row_at(y, z);
        std::uint8_t* const near = &near_[static_cast<std::size_t>(other) * static_cast<std::size_t>(g.nx)];
        for (std::size_t s = 0; s < in_reach.size(); ++s) near[s] |= in_reach[s];
      }
    }
  }
}

}  // namespace sluice
