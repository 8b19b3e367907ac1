// Which particles interact, and how strongly: one row a particle that has a pressure. The rows serve as neighbour list
// of every operator, and as matrix of the pressure equation.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/cell_rows.h"
#include "solvers/mps/particles.h"
#include "solvers/mps/sparse_rows.h"

namespace sluice::mps {

/// The particles that a search looks through; particle k of an index is particle first + k of the run.
struct SearchSet {
  const RowIndex& index;
  std::size_t first;
  const Proximity* proximity = nullptr;  ///< of sets that are sorted as often as they move: walls and dummies
};

/// The search's distances.
struct Reach {
  double quantum_m = 0;  ///< of the coordinates, in which pair distances are
  double effective_radius_m = 0;
  double list_radius_m = 0;  ///< what is listed: a little more, so that the list outlives a small displacement
  double near_radius_m = 0;  ///< of the near neighbours, no more than the effective radius
};

/// Two rows a particle, with weights omega_ij as values: near neighbours that have a pressure, which collide and
/// smooth; and all others, of which dummies come first. Those who want all read both, and nothing is stored twice.
template <class Pack>
class NeighbourList {
 public:
  using Real = typename Lanes<Pack>::Real;

  /// Lists the neighbours of fluid particles and of walls that fluid can touch, and with them number densities and
  /// centroid deviations (Eqs. 17 and 30). Rows of other particles are empty and their number density is zero.
  void list(Particles<Pack>& particles, const SearchSet& fluid, const SearchSet& walls, const SearchSet& dummies,
            const Reach& reach, int threads);

  const SparseRows<Real>& near() const { return near_; }
  const SparseRows<Real>& far() const { return far_; }
  /// Those of row i of far() that have a pressure.
  Span far_with_pressure(std::size_t i) const {
    const Span s = far_.span(i);
    return {s.begin + dummies_[i], s.end};
  }
  /// Sums of the weights of near neighbours, and of far ones that have a pressure.
  Real near_weight(std::size_t i) const { return near_weight_[i]; }
  Real far_weight(std::size_t i) const { return far_weight_[i]; }
  /// Neighbours within the effective radius, of all kinds.
  std::uint32_t count(std::size_t i) const { return count_[i]; }
  std::int64_t memory_bytes() const;

 private:
  /// The row of one particle while it is filled. One a thread.
  struct Collector {
    void clear();
    /// Adds the neighbours of a particle that lie in one set, without weights.
    void find(const Particles<Pack>& particles, std::size_t self, const SearchSet& set);
    /// Weights and sums of those from `begin` on.
    void weigh(const Particles<Pack>& particles, std::size_t self, std::size_t begin);
    /// For a number of neighbours.
    void make_room(std::size_t wanted);
    /// How many of the neighbours (after part_near(), of the far ones) lie within the effective radius.
    std::size_t within() const;
    /// Takes the near ones out of the neighbours so far.
    void part_near(Real least_weight);

    Pack radius;        ///< effective radius   [quantum]
    Real list_radius2;  ///< square of what is listed   [quantum^2]
    std::size_t count = 0;
    std::vector<std::int32_t> column;
    std::vector<Real> weight;
    std::size_t near = 0;
    std::vector<std::int32_t> near_column;
    std::vector<Real> near_weight;
    Pack weights{};       ///< sum of omega_ij
    Vec3<Pack> moment{};  ///< sum of omega_ij r_ij   [quantum]
  };

  static void finish_sums(Particles<Pack>& particles, std::size_t i, const Collector& c, double quantum_m);

  SparseRows<Real> near_;
  SparseRows<Real> far_;
  std::vector<std::uint16_t> dummies_;  ///< at the begin of each row of far_
  std::vector<std::uint16_t> count_;
  std::vector<Real> near_weight_, far_weight_;
  std::vector<Collector> collectors_;
};

extern template class NeighbourList<double>;
extern template class NeighbourList<FloatPack>;

}  // namespace sluice::mps
