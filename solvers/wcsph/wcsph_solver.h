// The weakly compressible SPH solver: one class for the fast path (packs of single precision) and for the reference
// path (one lane of double precision).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solvers/cell_rows.h"
#include "solvers/moving_walls.h"
#include "solvers/phase_clock.h"
#include "solvers/scene.h"
#include "solvers/solver.h"
#include "solvers/tank.h"
#include "solvers/wcsph/pair_sums.h"
#include "solvers/wcsph/parameters.h"
#include "solvers/wcsph/particles.h"

namespace sluice::wcsph {

template <class Pack>
class WcsphSolver final : public Solver {
 public:
  /// Throws std::invalid_argument when a parameter is out of its range (the message names it).
  WcsphSolver(const Scene& scene, const Parameters& parameters, int threads);

  /// Throws std::runtime_error when the run has become unstable. What was computed stays readable.
  double step() override;

  double time_s() const override { return time_s_; }
  std::int64_t steps() const override { return steps_; }
  std::int64_t fluid_count() const override { return static_cast<std::int64_t>(fluid_.n); }
  std::int64_t solid_count() const override { return static_cast<std::int64_t>(walls_.n); }
  LostParticles lost() const override { return lost_; }
  PhaseTimes phases() const override { return clock_.times(); }
  std::int64_t memory_bytes() const override;
  std::map<std::string, double> facts() const override;
  PressureReading kernel_pressure(const Vec3d& point_m) const override;
  PressureReading wall_pressure(const Vec3d& point_m) const override;
  VelocityReading kernel_velocity(const Vec3d& point_m) const override;
  Vec3d wall_reaction_N(std::span<const std::int32_t> walls, const Box& fluid_within_m) const override;
  double wall_particle_pressure_Pa(std::int32_t wall) const override;
  double volume_fraction(const Vec3d& point_m) const override;
  double smoothing_length_m() const override { return parameters_.smoothing_length_m(); }
  FluidTotals totals() const override;
  ParticleSnapshot snapshot() const override;
  void visit_state(StateArchive& archive) override;

  const Particles<Pack>& fluid() const { return fluid_; }
  const Particles<Pack>& walls() const { return walls_; }
  // What the pair sums of a step are given.
  Sorted<Pack> sorted_fluid() const { return {fluid_, fluid_index_, travel_m_}; }
  SortedWalls<Pack> sorted_walls() const { return {{walls_, wall_index_, wall_travel_m_}, wall_proximity_}; }
  std::span<const std::int32_t> wet_walls() const { return wet_walls_; }
  const PairConstants<Pack>& constants() const { return constants_; }
  /// Replaces velocity and density deviation of the fluid particle with an id: for tests with known answers.
  void set_fluid(std::int32_t id, const Vec3d& velocity_m_s, double density_deviation_kg_m3);

 private:
  void place_fluid(const Scene& scene);
  void place_walls(const Scene& scene);
  double hydrostatic_level_m(const Scene& scene, const Vec3d& point_m, double reach_m) const;
  void fill_hydrostatically(Particles<Pack>& particles, std::size_t i, double level_m) const;
  void sort_walls();
  void set_moving_walls(double t_s);
  void visit_moving_walls(StateArchive& archive);
  std::size_t wall_of(std::size_t i) const { return static_cast<std::size_t>(walls_.id[i] - first_wall_id_); }
  Vec3d reaction_of(std::size_t i, const Box& fluid_within_m) const;

  // The phases of a step.
  StepLimits sum_rates();
  void advance(double dt_s);
  void move_walls(double dt_s);
  double hold_at_walls(double dt_s);
  void sort_if_due(bool at_once = false);
  void update_fluid_state();
  void update_walls();
  void find_wet_walls();

  Parameters parameters_;
  int threads_;
  Tank tank_;
  PairConstants<Pack> constants_;
  Particles<Pack> fluid_;
  Particles<Pack> walls_;
  RowIndex fluid_index_;
  RowIndex wall_index_;
  Proximity wall_proximity_;
  MovingWalls moving_walls_;
  std::int32_t first_wall_id_ = 0;
  std::vector<std::int8_t> wall_layer_;   ///< in the order of Scene::walls
  std::vector<std::int32_t> wall_place_;  ///< where each of Scene::walls is now
  double wall_travel_m_ = 0;              ///< of the body that moved most, since walls were last sorted
  double walls_at_s_ = 0;                 ///< the time to which moving walls have been brought
  double walls_sorted_at_s_ = 0;
  std::vector<std::uint8_t> wet_;
  std::vector<std::int32_t> wet_walls_;  ///< wall particles that fluid can reach before the next sort
  std::vector<std::uint8_t> leaves_;
  double travel_m_ = 0;
  double time_s_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t sorts_ = 0;
  std::int64_t held_ = 0;  ///< times that a particle was set back at a wall
  LostParticles lost_;
  PhaseClock clock_;
};

extern template class WcsphSolver<FloatPack>;
extern template class WcsphSolver<double>;

}  // namespace sluice::wcsph

namespace sluice {

/// The fast path.
std::unique_ptr<Solver> make_wcsph_solver(const Scene& scene, const wcsph::Parameters& parameters, int threads);

}  // namespace sluice
