// The moving particle semi-implicit solver: one class for the fast path (packs of single precision) and for the
// reference path (one lane of double precision).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "solvers/cell_rows.h"
#include "solvers/moving_walls.h"
#include "solvers/mps/collisions.h"
#include "solvers/mps/neighbours.h"
#include "solvers/mps/operators.h"
#include "solvers/mps/parameters.h"
#include "solvers/mps/particles.h"
#include "solvers/mps/pressure_equation.h"
#include "solvers/phase_clock.h"
#include "solvers/scene.h"
#include "solvers/solver.h"
#include "solvers/tank.h"

namespace sluice::mps {

template <class Pack>
class MpsSolver final : public Solver {
 public:
  /// Throws std::invalid_argument when a parameter is out of its range (the message names it), or when the scene's
  /// walls have fewer than three layers.
  MpsSolver(const Scene& scene, const Parameters& parameters, int threads);

  /// Throws NotConverged, and std::runtime_error when the run has become unstable. What was computed stays readable.
  double step() override;

  double time_s() const override { return time_s_; }
  std::int64_t steps() const override { return steps_; }
  std::int64_t fluid_count() const override { return static_cast<std::int64_t>(particles_.fluid); }
  std::int64_t solid_count() const override { return static_cast<std::int64_t>(particles_.first_fluid()); }
  LostParticles lost() const override { return lost_; }
  PhaseTimes phases() const override { return clock_.times(); }
  std::int64_t memory_bytes() const override;
  std::map<std::string, double> facts() const override;
  PressureReading kernel_pressure(const Vec3d& point_m) const override;
  /// The pressure of the wall particle nearest to the point.
  PressureReading wall_pressure(const Vec3d& point_m) const override;
  VelocityReading kernel_velocity(const Vec3d& point_m) const override;
  Vec3d wall_reaction_N(std::span<const std::int32_t> walls, const Box& fluid_within_m) const override;
  double wall_particle_pressure_Pa(std::int32_t wall) const override;
  /// Walls act where their particles are, and the free surface (P = 0) lies where its particles are: by that, the
  /// pressure at the bottom of n layers is that of n l0, and so is their depth (measured: of some 0.4 l0 less).
  double wall_setback_m() const override { return 0.5 * constants_.parameters.particle_distance_m; }
  double volume_fraction(const Vec3d& point_m) const override;
  double smoothing_length_m() const override { return 0.5 * constants_.parameters.effective_radius_m(); }
  FluidTotals totals() const override;
  /// Unknowns, iterations, and the relative residual before the first and after each.
  std::string step_note() const override;
  ParticleSnapshot snapshot() const override;
  void visit_state(StateArchive& archive) override;

  const Particles<Pack>& particles() const { return particles_; }
  const NeighbourList<Pack>& neighbours() const { return list_; }
  const PressureEquation<Pack>& pressure_equation() const { return pressure_equation_; }
  const Parameters& parameters() const { return constants_.parameters; }
  // What the operators of a step are given.
  const OperatorConstants& constants() const { return constants_; }
  const Reach& reach() const { return reach_; }
  SearchSet fluid_set() const { return {fluid_index_, particles_.first_fluid()}; }
  SearchSet wall_set() const { return walls_.set(); }
  SearchSet dummy_set() const { return dummies_.set(); }
  const VectorField<double>& normals_of_walls() const { return wall_normals_; }
  /// Replaces the velocity of the fluid particle with an id: for tests with known answers.
  void set_velocity(std::int32_t id, const Vec3d& velocity_m_s);

 private:
  /// Wall or dummy particles: which of Scene::walls they are, and in what order they lie among the particles.
  struct Solids {
    Solids(const RowGeometry& geometry, std::vector<std::int32_t> which)
        : walls(std::move(which)), index(geometry), proximity(index) {}
    SearchSet set() const { return {index, first, &proximity}; }
    std::int64_t memory_bytes() const { return bytes(walls) + index.memory_bytes() + proximity.memory_bytes(); }

    std::vector<std::int32_t> walls;
    std::size_t first = 0;
    RowIndex index;
    Proximity proximity;
  };
  void place(const Scene& scene);
  std::vector<std::int32_t> sort_solids(Solids& solids);
  Box set_moving_walls(double t_s);
  void bring_walls_to(double t_s);
  void copy_wall_velocities();
  void find_normals(const Box& moved);
  std::size_t place_of(std::int32_t wall) const {
    return static_cast<std::size_t>(wall_place_[static_cast<std::size_t>(wall)]);
  }
  Vec3d reaction_of(std::size_t i, const Box& fluid_within_m) const;

  // The phases of a step.
  void predict();
  void collide_pairs();
  void move();
  void list_neighbours();
  void list_rows();
  void solve_pressures();
  void correct_velocities();

  void visit_counts(StateArchive& archive);
  void list_as_before();
  double greatest_number_density() const;  ///< of the fluid, where neighbours were last listed

  int threads_;
  Tank tank_;
  OperatorConstants constants_;
  Reach reach_;
  Particles<Pack> particles_;
  RowIndex fluid_index_;
  Solids walls_;
  Solids dummies_;
  MovingWalls moving_walls_;
  std::vector<std::int32_t> wall_place_;  ///< the particle that each of Scene::walls is
  std::int32_t first_wall_id_ = 0;
  std::vector<std::int8_t> moving_body_;  ///< of each of Scene::walls, 0: none; empty where nothing moves
  VectorField<double> wall_normals_;
  VectorField<double> listed_;  ///< where fluid particles were when neighbours were last listed   [m]
  NeighbourList<Pack> list_;
  PressureEquation<Pack> pressure_equation_;
  VectorField<typename Lanes<Pack>::Real> next_velocity_;
  std::vector<std::uint8_t> leaves_;
  double travel_m_ = 0;
  double time_s_ = 0;
  std::int64_t steps_ = 0;
  LostParticles lost_;
  PhaseClock clock_;
  // Over the whole run.
  std::int64_t iterations_ = 0;
  std::int64_t most_iterations_ = 0;
  std::int64_t unknowns_ = 0;
  std::int64_t collisions_ = 0;
  std::int64_t plain_gradients_ = 0;
  std::int64_t negative_pressures_ = 0;
  std::int64_t fluid_steps_ = 0;
  double greatest_density_ratio_ = 0;
};

extern template class MpsSolver<FloatPack>;
extern template class MpsSolver<double>;

}  // namespace sluice::mps

namespace sluice {

/// The fast path.
std::unique_ptr<Solver> make_mps_solver(const Scene& scene, const mps::Parameters& parameters, int threads);

}  // namespace sluice
