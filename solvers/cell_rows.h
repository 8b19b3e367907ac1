// Neighbour search by rows. Space is cut into square rows along x, a little wider than the kernel's radius, and every
// row into narrow slices. Particles are kept sorted by (row, slice), so that the neighbours of a particle are at most
// nine contiguous runs: in each row around it the slices that the kernel's sphere can reach at that row's distance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solvers/scene.h"
#include "solvers/vec3.h"

namespace sluice {

/// Consecutive particles begin .. end - 1 of the sorted order.
struct Run {
  std::int32_t begin = 0;
  std::int32_t end = 0;
};

/// Nine runs, empty ones among them.
using Runs = std::array<Run, 9>;

/// The geometry of rows and slices over a domain.
struct RowGeometry {
  Box domain;
  double radius_m = 0;  ///< kernel radius 2h
  double slack_m = 0;   ///< how far particles may travel between two sorts
  double edge_m = 0;    ///< width of a row
  double slice_m = 0;   ///< length of a slice
  std::int32_t nx = 0;  ///< slices in a row
  std::int32_t ny = 0;
  std::int32_t nz = 0;

  /// One empty row on each side, so that every particle has nine rows around it.
  RowGeometry(const Box& domain_m, double radius_m, double slack_m, double slice_m);

  std::int32_t rows() const { return ny * nz; }
  std::int32_t row_y(double y) const { return static_cast<std::int32_t>((y - domain.lower.y) / edge_m) + 1; }
  std::int32_t row_z(double z) const { return static_cast<std::int32_t>((z - domain.lower.z) / edge_m) + 1; }
  std::int32_t row(double y, double z) const { return row_z(z) * ny + row_y(y); }
  std::int32_t slice(double x) const { return static_cast<std::int32_t>((x - domain.lower.x) / slice_m); }
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
  /// Particles of one row.
  Run row(std::int32_t row) const { return {start_[at(row, 0)], start_[at(row, geometry_.nx)]}; }
  const RowGeometry& geometry() const { return geometry_; }

  /// The runs that hold every particle within the kernel's radius of a point, if no particle has travelled more than
  /// travel_m since the sort (travel_m <= slack).
  Runs neighbours(const Vec3d& point_m, double travel_m) const {
    return neighbours(point_m, geometry_.row(point_m.y, point_m.z), travel_m);
  }
  /// The same for a point that lay in `row` when the particles were sorted and may have left it since. Run k lies in
  /// the row k % 3 - 1 further along y and k / 3 - 1 further up.
  Runs neighbours(const Vec3d& point_m, std::int32_t row, double travel_m) const;

  /// Whether a particle may come within the kernel's radius of a point before the next sort. May say yes for one that
  /// stays a little beyond it, never no for one that does not.
  bool any_near(const Vec3d& point_m) const;

  std::int64_t memory_bytes() const;

 private:
  std::size_t at(std::int32_t row, std::int32_t slice) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(geometry_.nx + 1) + static_cast<std::size_t>(slice);
  }
  void sort_into_rows(std::span<const double> y, std::span<const double> z, std::span<const std::uint8_t> leaves,
                      int threads);
  void sort_row_into_slices(std::int32_t row, std::span<const double> x, std::vector<std::int32_t>& scratch);

  /// One lane for each of the nine rows around a point (the others never match): the distance to the row across y is
  /// y_offset + y_slope * y, where y is measured from the own row's lower side; z likewise; base is the row's offset in
  /// start_.
  struct Stencil {
    static constexpr std::size_t lanes = 16;
    std::array<float, lanes> y_offset{}, y_slope{}, z_offset{}, z_slope{};
    std::array<std::int32_t, lanes> base{};
  };
  static Stencil stencil(const RowGeometry& geometry);

  RowGeometry geometry_;
  Stencil stencil_;
  std::vector<std::int32_t> order_;      ///< old index by new index
  std::vector<std::int32_t> by_row_;     ///< the order after the first pass
  std::vector<std::int32_t> row_start_;  ///< rows + 1
  std::vector<std::int32_t> start_;      ///< first particle of each slice, (nx + 1) a row
};

}  // namespace sluice
