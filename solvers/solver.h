// What every solver offers to a harness: time steps, what its sensors see, what it lost, what each phase cost.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "solvers/box.h"
#include "solvers/vec3.h"

namespace sluice {

/// Fluid particles that left. Over the open top is physical; through a wall is an error of the method.
struct LostParticles {
  std::int64_t over_top = 0;
  std::int64_t through_walls = 0;
};

/// What a sensor read, and how much fluid it had to read from.
struct PressureReading {
  double pressure_Pa = 0;
  double support = 0;  ///< share of the kernel's (or the patch's) support that was filled, 0..1 or a little over
};

/// What a velocity probe read.
struct VelocityReading {
  Vec3d velocity_m_s;
  double support = 0;  ///< as above
};

/// The fluid as a whole.
struct FluidTotals {
  double kinetic_energy_J = 0;
  double potential_energy_J = 0;      ///< in gravity, zero at the origin
  double greatest_density_ratio = 0;  ///< rho / rho_0 of the densest particle (MPS: n / n0)
};

/// A copy of the particles for pictures and for tests, fluid first.
struct ParticleSnapshot {
  double time_s = 0;
  std::size_t fluid_count = 0;
  std::vector<Vec3<float>> position_m;
  std::vector<Vec3<float>> velocity_m_s;
  std::vector<float> pressure_Pa;
  std::vector<float> density_kg_m3;
  std::vector<std::int32_t> id;  ///< stays with a particle for the whole run
};

/// Seconds of wall time by the name of the phase.
using PhaseTimes = std::map<std::string, double>;

class StateArchive;

class Solver {
 public:
  virtual ~Solver() = default;

  /// One time step of the solver's own choice. Returns its length [s].
  virtual double step() = 0;

  virtual double time_s() const = 0;
  virtual std::int64_t steps() const = 0;
  virtual std::int64_t fluid_count() const = 0;
  virtual std::int64_t solid_count() const = 0;
  virtual LostParticles lost() const = 0;
  virtual PhaseTimes phases() const = 0;
  /// Bytes held in the solver's arrays.
  virtual std::int64_t memory_bytes() const = 0;
  /// Whole-run facts for the manifest that only this solver knows, name to value (such as "c0_m_s").
  virtual std::map<std::string, double> facts() const = 0;

  /// Kernel-weighted mean pressure of the fluid at a point (the paper's normalised sum).
  virtual PressureReading kernel_pressure(const Vec3d& point_m) const = 0;
  /// Pressure of the wall at a point on it. WCSPH: the mean of the first layer's particles within one smoothing length;
  /// MPS: the particle nearest to the point.
  virtual PressureReading wall_pressure(const Vec3d& point_m) const = 0;
  /// Kernel-weighted mean velocity of the fluid at a point.
  virtual VelocityReading kernel_velocity(const Vec3d& point_m) const = 0;
  /// Force of the fluid within a region on wall particles, named by their places in Scene::walls [N]: mass times the
  /// acceleration that they would have from the fluid around them, gravity apart.
  virtual Vec3d wall_reaction_N(std::span<const std::int32_t> walls, const Box& fluid_within_m) const = 0;
  /// Pressure of one wall particle of a first layer, named likewise [Pa].
  virtual double wall_particle_pressure_Pa(std::int32_t wall) const = 0;
  /// How far behind their faces, which lie half-way between wall and fluid particles, walls act [m].
  virtual double wall_setback_m() const { return 0; }
  /// Smoothed volume fraction of fluid at a point: 1 inside, 0 outside, one half at a plane free surface.
  virtual double volume_fraction(const Vec3d& point_m) const = 0;
  /// The smoothing length h [m] (MPS: half the effective radius): the scale of offsets from walls.
  virtual double smoothing_length_m() const = 0;

  virtual FluidTotals totals() const = 0;
  /// One line on the last step that a log may hold (MPS: how its pressure equation converged); empty: nothing to tell.
  virtual std::string step_note() const { return {}; }

  virtual ParticleSnapshot snapshot() const = 0;

  /// Saves what the next steps depend on, or restores it into a solver of the same scene and parameters: that one then
  /// goes on bit for bit like the one that was saved, on any number of threads. Call it between two steps.
  /// Restoring throws std::runtime_error when the archive does not fit; the solver is then of no use.
  virtual void visit_state(StateArchive& archive) = 0;
};

}  // namespace sluice
