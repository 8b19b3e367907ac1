// Run directories made by hand, with errors that are known: for tests, and for looking at the report without a run.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sluice::synthetic {

/// What a made-up run does to the measured curves: scale x curve(t - shift).
struct MadeRun {
  std::string solver = "wcsph";
  std::string walls = "extrapolated";
  double l0_m = 0.02;
  double alpha = 0.01;
  double scale = 1.0;         ///< of the primary pressure reading and of wave heights
  double second_scale = 0.9;  ///< of the other pressure model
  double shift_s = 0.0;
  double t_end_s = 6.0;   ///< where the samples end
  double noise_Pa = 0.0;  ///< a fixed 90 Hz tone on pressures
  std::string status = "finished";
};

/// Writes run.json and probes.csv of a run of the case `kleefsman` made from its measured digest.
void write_run(const std::filesystem::path& directory, const MadeRun& run);

/// A run of a case with forces and velocity probes, made from what was measured; where nothing was, from a pulse of 10
/// N between 0.5 and 0.7 s.
struct MadeForceRun {
  std::string case_name = "column";
  std::string solver = "wcsph";
  std::string walls = "extrapolated";
  double l0_m = 0.0125;
  double alpha = 0.01;
  double scale = 1.0;         ///< of the primary route and of velocities
  double second_scale = 0.9;  ///< of the other route
  double shift_s = 0.0;
  double noise_N = 0.0;                        ///< a fixed 90 Hz tone on forces
  std::map<std::string, double> parameters{};  ///< otherwise than in the case
};
void write_force_run(const std::filesystem::path& directory, const MadeForceRun& run);

/// Another code's delivery: three lines of run.json, plain columns P1 and H2 only.
void write_external_run(const std::filesystem::path& directory, double scale);

/// Snapshots of a case's water at rest at the given times.
void write_snapshots(const std::filesystem::path& directory, const std::vector<double>& times_s, double l0_m,
                     const std::string& case_name = "kleefsman");

}  // namespace sluice::synthetic
