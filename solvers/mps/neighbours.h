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
  const Proximity* proximity = nullptr;  ///< of sets that do not move
};

/// Distances of the weight in quanta of the coordinates.
struct Reach {
  double quantum_m = 0;
  double effective_radius_m = 0;
  double list_radius_m = 0;  ///< what is listed: a little more, so that the list outlives a small displacement
  double near_radius_m = 0;  ///< of the near neighbours, no more than the effective radius
};

/// Row i: first neighbours that have a pressure (fluid, then walls), then dummies; values are weights omega_ij.
template <class Pack>
class NeighbourList {
 public:
  using Real = typename Lanes<Pack>::Real;

  /// Lists the neighbours of fluid particles and of walls that fluid can touch, and with them number densities and
  /// centroid deviations (Eqs. 17 and 30). Rows of other particles are empty and their number density is zero.
  void list(Particles<Pack>& particles, const SearchSet& fluid, const SearchSet& walls, const SearchSet& dummies,
            const Reach& reach, int threads);

  /// All neighbours of particle i, and those that have a pressure.
  Span all(std::size_t i) const { return rows_.span(i); }
  Span with_pressure(std::size_t i) const {
    const Span s = rows_.span(i);
    return {s.begin, s.end - dummies_[i]};
  }
  /// A copy of the rows with nothing but near neighbours that have a pressure: less to read for those who can do
  /// without the others.
  const SparseRows<Real>& near() const { return near_; }
  const std::int32_t* columns() const { return rows_.columns(); }
  const Real* weights() const { return rows_.values(); }
  std::int64_t memory_bytes() const;

 private:
  /// The row of one particle while it is filled. One a thread.
  struct Collector {
    void clear();
    /// Adds the neighbours of a particle that lie in one set.
    void add(const Particles<Pack>& particles, std::size_t self, const SearchSet& set);
    void make_room(std::size_t wanted);
    /// Copies the near ones among the neighbours so far.
    void pick_near(Real least_weight);

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

  void finish_row(Particles<Pack>& particles, std::size_t i, const Collector& c, double quantum_m,
                  typename SparseRows<Real>::Writer& writer, std::size_t dummies);

  SparseRows<Real> rows_;
  SparseRows<Real> near_;
  std::vector<std::uint16_t> dummies_;  ///< at the end of each row
  std::vector<Collector> collectors_;
};

extern template class NeighbourList<double>;
extern template class NeighbourList<FloatPack>;

}  // namespace sluice::mps
