// Neighbour search by rows. Space is cut into square rows along x, a little wider than the kernel's radius, and every
// row into narrow slices. Particles are kept sorted by (row, slice), so that the neighbours of a particle are at most
// nine contiguous runs: in each row around it the slices that the kernel's sphere can reach at that row's distance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solvers/scene.h"
#include "solvers/vec3.h"

namespace sluice {

class StateArchive;

/// Consecutive particles begin .. end - 1 of the sorted order.
struct Run {
  std::int32_t begin = 0;
  std::int32_t end = 0;
};

/// How many rows away a neighbour may be, along y and z. Two, with rows half as wide, fit the sphere better (120
/// candidates a particle instead of 190) but were slower: runs become shorter than a vector.
constexpr std::int32_t reach_rows = 1;
constexpr std::size_t rows_around = (2 * reach_rows + 1) * (2 * reach_rows + 1);

/// The runs around a particle, empty ones among them; its own row's comes first, then those of the other rows that come
/// after it.
using Runs = std::array<Run, rows_around>;
/// The first of them: with the own row's from the particle on, they visit every pair once.
using ForwardRuns = std::array<Run, (rows_around + 1) / 2>;
using ForwardStarts = std::array<std::int32_t, std::tuple_size_v<ForwardRuns>>;

/// The geometry of rows and slices over a domain.
struct RowGeometry {
  Box domain;
  double radius_m = 0;  ///< kernel radius 2h
  double slack_m = 0;   ///< how far particles may travel between two sorts
  double edge_m = 0;    ///< width of a row
  double slice_m = 0;   ///< length of a slice
  double rows_per_m = 0;
  double slices_per_m = 0;
  std::int32_t nx = 0;  ///< slices in a row
  std::int32_t ny = 0;
  std::int32_t nz = 0;

  /// Empty rows on each side, so that every particle has all rows around it.
  RowGeometry(const Box& domain_m, double radius_m, double slack_m, double slice_m);

  std::int32_t rows() const { return ny * nz; }
  std::int32_t row_y(double y) const {
    return static_cast<std::int32_t>((y - domain.lower.y) * rows_per_m) + reach_rows;
  }
  std::int32_t row_z(double z) const {
    return static_cast<std::int32_t>((z - domain.lower.z) * rows_per_m) + reach_rows;
  }
  /// Rows one above the other lie together in memory: water is flat, so that the rows around a particle are nearer to
  /// one another than if those beside each other did.
  std::int32_t row_at(std::int32_t row_y, std::int32_t row_z) const { return row_y * nz + row_z; }
  std::int32_t row(double y, double z) const { return row_at(row_y(y), row_z(z)); }
  std::int32_t slice(double x) const { return static_cast<std::int32_t>((x - domain.lower.x) * slices_per_m); }
};

/// The sorted order of a set of particles. The order of particles in one slice is that of the previous order (the sort
/// is stable), for any number of threads.
class RowIndex {
 public:
  explicit RowIndex(const RowGeometry& geometry);

  /// Sorts; particle k of the new order was order()[k] of the old one. Particles with leaves[i] != 0 are dropped.
  /// Positions [m] must lie inside the domain, except those of particles that leave.
  void sort(std::span<const double> x, std::span<const double> y, std::span<const double> z,
            std::span<const std::uint8_t> leaves, int threads);

  std::span<const std::int32_t> order() const { return order_; }
  std::int32_t size() const { return static_cast<std::int32_t>(order_.size()); }
  /// Particles of slices first .. last - 1 of a row.
  Run slices(std::int32_t row, std::int32_t first, std::int32_t last) const {
    return {start_[at(row, first)], start_[at(row, last)]};
  }
  const RowGeometry& geometry() const { return geometry_; }

  /// The runs that hold every particle within the kernel's radius of a point, if no particle has travelled more than
  /// travel_m since the sort (travel_m <= slack).
  Runs neighbours(const Vec3d& point_m, double travel_m) const {
    return neighbours(point_m, row_search(geometry_.row_y(point_m.y), geometry_.row_z(point_m.z)), travel_m);
  }
  /// What the searches of all particles of one row have in common.
  struct Row {
    double y_m = 0;  ///< its lower sides
    double z_m = 0;
    const std::int32_t* start = nullptr;  ///< of its slices
  };
  Row row_search(std::int32_t row_y, std::int32_t row_z) const;
  /// As above for a point that lay in `row` when the particles were sorted and may have left it since.
  Runs neighbours(const Vec3d& point_m, const Row& row, double travel_m) const;
  /// The own row and those that come after it: further along y by up to reach_rows, or at the same y and higher.
  ForwardRuns forward(const Vec3d& point_m, const Row& row, double travel_m) const;
  /// The first particle of a slice in each of the rows of forward(), or what follows the row's last (slice = nx). The
  /// row must not be one of the empty ones at the domain's sides.
  ForwardStarts forward_starts(const Row& row, std::int32_t slice) const {
    ForwardStarts starts;
    for (std::size_t k = 0; k < starts.size(); ++k) starts[k] = row.start[stencil_.base[k] + slice];
    return starts;
  }

  /// Whether a particle may come within the kernel's radius of a point before the next sort. May say yes for one that
  /// stays a little beyond it, never no for one that does not.
  bool any_near(const Vec3d& point_m) const;

  std::int64_t memory_bytes() const;

  /// Saves or restores the order of n sorted particles.
  void visit_state(StateArchive& archive, const std::string& name, std::size_t n);

 private:
  std::size_t at(std::int32_t row, std::int32_t slice) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(geometry_.nx + 1) + static_cast<std::size_t>(slice);
  }
  void sort_into_rows(std::span<const double> y, std::span<const double> z, std::span<const std::uint8_t> leaves,
                      int threads);
  void sort_row_into_slices(std::int32_t row, std::span<const double> x, std::vector<std::int32_t>& scratch);

  /// One lane for each of the rows around a point, those of forward() first; lanes to spare never match.
  /// The distance to the row across y is y_offset + y_slope * y, where y is measured from the own row's lower side; z
  /// likewise; base is the row's offset in start_.
  struct Stencil {
    static constexpr std::size_t lanes = 16;
    static_assert(rows_around <= lanes);
    std::array<float, lanes> y_offset{}, y_slope{}, z_offset{}, z_slope{};
    std::array<std::int32_t, lanes> base{};
    float per_slice = 0;  ///< 1 / slice_m
    float radius2 = 0;    ///< radius_m^2
  };
  static Stencil stencil(const RowGeometry& geometry);
  /// Writes the runs of the stencil's first N lanes.
  template <std::size_t N>
  std::array<Run, N> find_runs(const Vec3d& point_m, const Row& row, double travel_m) const;

  RowGeometry geometry_;
  Stencil stencil_;
  std::vector<std::int32_t> order_;      ///< old index by new index
  std::vector<std::int32_t> by_row_;     ///< the order after the first pass
  std::vector<std::int32_t> row_start_;  ///< rows + 1
  std::vector<std::int32_t> start_;      ///< first particle of each slice, (nx + 1) a row
};

/// Which points may have particles of a sorted set within the kernel's radius, as long as that set moves by no more
/// than the slack of its index: a look-up of one byte.
class Proximity {
 public:
  /// The index must be sorted.
  explicit Proximity(const RowIndex& index);

  /// May say yes for a point a little too far away, never no for one that is not. The point must lie in the domain.
  bool any_near(const Vec3d& point_m) const {
    return near_[static_cast<std::size_t>(geometry_.row(point_m.y, point_m.z)) *
                     static_cast<std::size_t>(geometry_.nx) +
                 static_cast<std::size_t>(geometry_.slice(point_m.x))] != 0;
  }
  std::int64_t memory_bytes() const { return static_cast<std::int64_t>(near_.capacity()); }

 private:
  RowGeometry geometry_;
  std::vector<std::uint8_t> near_;  ///< by row and slice
};

}  // namespace sluice
