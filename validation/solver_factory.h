// The one place that knows which solvers exist: their numeric parameters by name, and how to make them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/scene.h"
#include "solvers/solver.h"
#include "validation/case.h"
#include "validation/run_settings.h"

namespace sluice {

/// Names of all solvers that this program has.
const std::vector<std::string>& solver_names();

/// Whether this program has a solver of that name.
bool has_solver(std::string_view solver);

/// Names of the numeric parameters that a solver takes; empty for an unknown solver.
std::vector<std::string> solver_parameter_names(std::string_view solver);

/// The sensor model that a solver's wall_pressure() is: "wall" (a mean; also where the solver is unknown) or "nearest".
std::string wall_pressure_model(std::string_view solver);

/// Every parameter's value for this case: given ones checked, those left out derived (the speed of sound from the
/// water's height). Throws std::invalid_argument `key: what is wrong (remedy)`.
std::map<std::string, double> complete_parameters(const Case& c, std::string_view solver,
                                                  const std::map<std::string, double>& given);

/// nu0 = alpha h c0 / (2 (3 + 2)) of the paper [m2/s], or the kinematic viscosity of a solver that has one.
std::optional<double> equivalent_viscosity_m2_s(const RunSettings& settings);

/// What a run costs, for plans.
struct SolverCost {
  double bytes_per_particle = 0;
  double dt_s = 0;  ///< mean time step
  double fluid_steps_per_s_and_thread = 0;
  double whole_run_over_first_steps = 1;  ///< time that a step takes on the mean, over that of a case's first ones
  double solid_over_fluid =
      0;  ///< time that a particle of a wall takes in a step, over that of one of fluid (by the runs on record)
};

/// Throws std::invalid_argument for an unknown solver.
SolverCost solver_cost(const RunSettings& settings);

/// Throws std::invalid_argument for an unknown solver.
std::unique_ptr<Solver> make_solver(const Case& c, const Scene& scene, const RunSettings& settings);

}  // namespace sluice
