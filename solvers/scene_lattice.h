// The lattice of a scene: every box fitted to whole cells, whose centres are the particles' places.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "solvers/scene.h"

namespace sluice {

using Index3 = std::array<std::int64_t, 3>;

constexpr char axis_name(int axis) {
  return static_cast<char>('x' + axis);
}
/// Lengths that differ by no more are the same.
inline constexpr double same_length_m = 1e-9;

/// A box in lattice cells: first cell and one past the last.
struct CellBox {
  Index3 lower{};
  Index3 upper{};

  bool contains(const Index3& c) const;
  CellBox grown(std::int64_t n) const;
  CellBox shared_with(const CellBox& o) const;  ///< empty boxes have no cells
  double cells() const;
};

/// Cell (0, 0, 0) begins at the tank's lower corner. Throws std::invalid_argument when a box makes no sense at this
/// particle distance (the message names it).
class SceneLattice {
 public:
  explicit SceneLattice(const SceneDescription& description);

  const CellBox& tank() const { return tank_; }
  const std::vector<CellBox>& fluid() const { return fluid_; }
  const std::vector<CellBox>& obstacles() const { return obstacles_; }

  Vec3d centre(const Index3& cell) const;
  Box box(const CellBox& cells) const;

 private:
  double in_cells(double x_m, int axis) const;
  void require_cells(const CellBox& c, const std::string& name) const;
  CellBox rounded(const Box& b) const;
  CellBox nearest(const Box& b, const std::string& name) const;
  CellBox nearest_obstacle(std::size_t k, const std::string& name) const;
  CellBox best_volume(const Box& b, const std::string& name) const;
  CellBox faces(const Box& b, int choice) const;
  std::int64_t face(double x_m, int axis, bool up) const;
  void thicken(CellBox& plate, std::size_t k, int axis) const;
  double cells_taken(const CellBox& plate, std::size_t k) const;
  void refuse_shared_cells() const;

  const SceneDescription& d_;
  double l0_;
  CellBox tank_;
  std::vector<CellBox> fluid_;
  std::vector<CellBox> obstacles_;
};

}  // namespace sluice
