// A case set up for timing: disordered from the start, since on the initial lattice every code is up to twice as fast
// as in the flow that follows.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "solvers/scene.h"
#include "solvers/solver.h"
#include "validation/case.h"
#include "validation/run_settings.h"
#include "validation/sensors.h"

namespace sluice::bench {

/// Displaces the fluid by up to jitter l0 along every axis, the same way each time: disorder at once, for sizes at
/// which the flow takes an hour to make it.
void disorder(Scene& scene, double jitter);

/// The particle distance at which the case's fluid is about so many particles   [m]
double particle_distance_m(const Case& c, double fluid_particles);

struct PreparedRun {
  PreparedRun(Case the_case, RunSettings run_settings, double jitter);

  Case c;
  RunSettings settings;
  Scene scene;
  std::unique_ptr<Solver> solver;
  SensorArray sensors;
};

/// The dam break of Kleefsman et al. with about so many fluid particles, displaced by up to a fifth of l0.
PreparedRun prepare(const std::string& solver, const std::string& walls, double fluid_particles, int threads);

/// What a ledger must know of where numbers come from: machine, cpu, commit, compiler, flags of this build.
std::map<std::string, std::string> provenance();

/// What a solver's steps cost between the meter's making and its reading.
class StepMeter {
 public:
  explicit StepMeter(const Solver& solver);

  struct Reading {
    double steps = 0;
    double wall_s = 0;
    double cpu_s = 0;  ///< of all threads
    double simulated_s = 0;
    double iterations_a_step = 0;  ///< of the pressure equation; zero for a solver that has none
    PhaseTimes phases;
  };
  Reading read() const;

 private:
  static double iterations(const Solver& solver);

  const Solver& solver_;
  PhaseTimes phases_;
  double steps_;
  double time_s_;
  double iterations_;
  double cpu_s_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sluice::bench
