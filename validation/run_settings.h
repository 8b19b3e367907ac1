// What one run is to do: the case's defaults, a tier's or the command line's choices, all checked.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/case.h"

namespace sluice {

/// Choices for one run; what is left out comes from the case.
struct RunRequest {
  std::string solver;                                     ///< empty: the case's first
  std::string walls;                                      ///< empty: the solver's default
  std::optional<double> l0_m;                             ///< none: the tier "standard", or else the first tier
  int threads = 0;                                        ///< 0: OMP_NUM_THREADS, else all this process may use
  bool snapshots = false;                                 ///< at the case's times
  double snapshot_every_s = 0;                            ///< above 0: at this interval instead
  std::vector<std::pair<std::string, double>> overrides;  ///< key=value: t_end_s, output_rate_Hz, solver parameters
};

/// A complete and checked description of a run.
struct RunSettings {
  std::string solver;
  std::string walls;
  int wall_layers = 3;
  double l0_m = 0;
  double t_end_s = 0;
  double output_rate_Hz = 1000;
  int threads = 1;
  std::vector<double> snapshot_times_s;      ///< sorted, none after t_end_s
  std::map<std::string, double> parameters;  ///< every numeric parameter of the solver, every placement of the case
};

/// The case's geometry for a run, with its obstacles where the run places them. Throws std::invalid_argument naming the
/// placement where that is not inside the tank, or where something else is.
SceneDescription scene_description(const Case& c, const RunSettings& settings);

/// Throws std::invalid_argument naming the key, what is wrong and the remedy.
RunSettings resolve_settings(const Case& c, const RunRequest& request);

/// Splits "key=value". Throws std::invalid_argument when there is no `=` or the value is not a finite number.
std::pair<std::string, double> parse_override(const std::string& text);

/// Where a run goes unless told otherwise: runs/kleefsman-wcsph-extrapolated-l0.020-alpha0.01.
std::filesystem::path default_run_directory(const Case& c, const RunSettings& settings);

}  // namespace sluice
