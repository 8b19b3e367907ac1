// What run.json says of a run: at its start, and as it goes on.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solvers/scene.h"
#include "solvers/solver.h"
#include "validation/case.h"
#include "validation/run_settings.h"
#include "validation/sensors.h"

namespace sluice {

/// Counted by the harness while a run goes on. Seconds are wall time.
struct RunTally {
  double wall_s = 0;      ///< since the run began, with everything
  double stepping_s = 0;  ///< in the solver's steps
  double sensors_s = 0;
  double output_s = 0;  ///< snapshots and manifests
  double cpu_s = 0;
  double particle_steps = 0;  ///< fluid particles, summed over the steps
  double dt_min_s = std::numeric_limits<double>::infinity();
  double dt_max_s = 0;
  PhaseTimes earlier_phases;  ///< of a run that was resumed: what its solver's phases took before
};

/// What was asked for, by whom: all that is known before there is a scene; status "running".
nlohmann::json asked_manifest(const Case& c, const RunSettings& settings);

/// Everything that is known before the first step, status "running".
nlohmann::json start_manifest(const Case& c, const RunSettings& settings, const Scene& scene,
                              const std::vector<PlacedSensor>& sensors);

/// Brings what changes during a run up to date.
void update_manifest(nlohmann::json& manifest, const Solver& solver, const RunTally& tally);

}  // namespace sluice
