// A solver for tests of the harness: no particles move, the sensors read what a formula says.
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "solvers/scene.h"
#include "solvers/solver.h"
#include "solvers/state_archive.h"

namespace sluice {

/// Fixed time steps; the pressure everywhere is 1000 Pa/s times the time, and fluid stands 0.2 m deep everywhere.
class FakeSolver : public Solver {
 public:
  FakeSolver(Scene scene, double dt_s) : scene_(std::move(scene)), dt_s_(dt_s) {}

  std::function<void(FakeSolver&)> before_step;  ///< tests put trouble here
  double dt_s() const { return dt_s_; }
  void set_dt_s(double dt_s) { dt_s_ = dt_s; }
  void set_pressure_scale(double scale) { pressure_scale_ = scale; }

  double step() override {
    if (before_step) before_step(*this);
    time_s_ += dt_s_;
    ++steps_;
    return dt_s_;
  }
  double time_s() const override { return time_s_; }
  std::int64_t steps() const override { return steps_; }
  std::int64_t fluid_count() const override { return static_cast<std::int64_t>(scene_.fluid.size()); }
  std::int64_t solid_count() const override { return static_cast<std::int64_t>(scene_.walls.size()); }
  LostParticles lost() const override { return {3, 0}; }
  PhaseTimes phases() const override { return {{"sums", 0.5}}; }
  std::int64_t memory_bytes() const override { return 100 * (fluid_count() + solid_count()); }
  std::map<std::string, double> facts() const override { return {{"c0_m_s", 46.5}}; }
  PressureReading kernel_pressure(const Vec3d&) const override { return {pressure_scale_ * time_s_, 1.0}; }
  PressureReading wall_pressure(const Vec3d&) const override { return {2 * pressure_scale_ * time_s_, 1.0}; }
  VelocityReading kernel_velocity(const Vec3d&) const override { return {{3 * time_s_, 0, 0}, 1.0}; }
  /// A newton each along x.
  Vec3d wall_reaction_N(std::span<const std::int32_t> walls, const Box&) const override {
    return {static_cast<double>(walls.size()), 0, 0};
  }
  double wall_particle_pressure_Pa(std::int32_t) const override { return pressure_scale_ * time_s_; }
  double volume_fraction(const Vec3d& p) const override { return p.z < 0.2 && p.z > 0 ? 1.0 : 0.0; }
  double smoothing_length_m() const override { return 1.5 * scene_.description.particle_distance_m; }
  void visit_state(StateArchive& archive) override {
    archive.value("time_s", time_s_);
    archive.value("steps", steps_);
  }
  FluidTotals totals() const override { return {2 * time_s_, 5, 1.01}; }
  std::string step_note() const override { return "note of step " + std::to_string(steps_); }
  ParticleSnapshot snapshot() const override {
    ParticleSnapshot s;
    s.time_s = time_s_;
    s.fluid_count = 1;
    s.position_m = {{0.1f, 0.1f, 0.1f}};
    s.velocity_m_s = {{0, 0, 0}};
    s.pressure_Pa = {0};
    s.density_kg_m3 = {1000};
    s.id = {0};
    return s;
  }

 private:
  Scene scene_;
  double dt_s_;
  double time_s_ = 0;
  double pressure_scale_ = 1000;
  std::int64_t steps_ = 0;
};

}  // namespace sluice
