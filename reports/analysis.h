// What a report says about its runs, as numbers: every reading of every run compared with the measurement.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/acceptance.h"
#include "validation/case.h"
#include "validation/measurements.h"
#include "validation/metrics.h"
#include "validation/run_directory.h"

namespace sluice {

/// One sensor of one run as one model reads it.
struct SensorReading {
  std::string sensor;
  SensorKind kind = SensorKind::pressure;
  std::string model;     ///< "wall", "kernel", "column", "top"; empty: as another code delivers it
  bool primary = false;  ///< the reading that the case names for this solver and wall model
  Series series;
  Comparison comparison;

  bool warning_only = false;  ///< from the wall's own pressure with dynamic walls, which means nothing

  /// The model in words, "as delivered" when there is none.
  std::string model_name() const { return model.empty() ? "as delivered" : model; }
  /// The same with "(primary)" or "(warning only)".
  std::string remarked_model() const;
};

struct AnalysedRun {
  RunRecord record;
  std::string key;           ///< "R1", the same in every table and figure of the report
  std::string label;         ///< "R1 WCSPH extrapolated, α = 0.01, l0 20 mm"
  std::string short_label;   ///< "R1 α = 0.01, l0 20 mm": beside `group`
  std::string group;         ///< "WCSPH, extrapolated walls": runs that are drawn in one panel
  std::string method_label;  ///< "R1 WCSPH, α = 0.01": beside walls and l0
  std::string directory;     ///< as shown: never an absolute path
  std::string series_hash;   ///< of probes.csv, as file_hash() gives it; empty where there is none
  std::vector<SensorReading> readings;
  std::vector<AcceptanceCheck> acceptance;  ///< every row of the case, in its order
  std::vector<std::string> problems;        ///< what the reader should know before trusting this run

  const SensorReading* primary(const std::string& sensor) const;
  const SensorReading* find(const std::string& sensor, const std::string& model) const;
  std::vector<const SensorReading*> of(const std::string& sensor) const;
};

struct ReportData {
  Case the_case;
  Measurements measured;
  Window window;
  std::vector<AnalysedRun> runs;  ///< own before others, then by solver, walls, l0 (coarse first), alpha (large first)

  const MeasuredSeries* measured_series(const std::string& sensor) const;
  /// Over which the sensor is compared.
  Window window_of(const std::string& sensor) const;
  std::vector<std::string> sensors(SensorKind kind) const;
  bool has(SensorKind kind) const { return !sensors(kind).empty(); }
  /// By whose impulses runs are ranked: the pressure sensors for which the paper prints impulses, in its order; if it
  /// prints none all pressure sensors, or without these all forces.
  std::vector<std::string> headline_sensors() const;
  /// What a reader of this sensor's comparisons must know of its measurement: "Measured: missing.", or by how much its
  /// clock was shifted; empty when there is nothing to say.
  std::string measured_remark(const std::string& sensor) const;
};

/// The model in the middle of a column's name, "wall" of "P1_wall_Pa" for P1; nullopt when the column is another
/// sensor's or quantity's.
std::optional<std::string> model_of(const std::string& column, const CaseSensor& sensor);

/// Reads the runs and compares them; `bands`: a file of add_bands(), or none. Throws std::runtime_error when no run is
/// given, a run or the bands cannot be read, the runs are of several cases, or the case is unknown.
ReportData analyse(const std::vector<std::filesystem::path>& run_directories, const std::filesystem::path& bands = {});

/// What this run has set otherwise than the case, by name; without alpha, which has a place of its own everywhere.
/// Empty for other codes.
std::map<std::string, double> changed_parameters(const RunRecord& run, const Case& c);
/// ", delta = 0.02" for labels and titles; empty for none.
std::string parameters_text(const std::map<std::string, double>& parameters);

/// Whether a run of this program has ended, at the end of the case's window or later.
bool is_whole(const ReportData& data, const RunRecord& run);

/// Whether a run was stopped before its end, or its series ends before the window does (of finished runs of this
/// program only where another run does reach the window's end). What it has is true of the time that it covers, and
/// enters nothing that ranks, averages or fits runs.
bool ended_early(const ReportData& data, const AnalysedRun& run);
/// "Left out, since they ended early: R4, R8."; empty where none did.
std::string left_out_note(const ReportData& data);

/// Mean of |deviation| of the impulses over the headline sensors; missing when one of them is. `model` empty: primary.
std::optional<double> mean_impulse_error(const ReportData& data, const AnalysedRun& run, const std::string& model = "");

/// What a run cost: its processor time, summed over threads; where that is not stated, wall time times threads. It
/// depends less than wall time on what else a machine did.
std::optional<double> processor_time_s(const AnalysedRun& run);

/// The machine that computed the whole of a run; missing where it is not stated or where parts are of several.
std::optional<std::string> machine_of(const AnalysedRun& run);

/// Groups of runs for figures: by solver and walls, at most `limit` in each.
struct RunGroup {
  std::string title;
  std::vector<const AnalysedRun*> runs;
};
std::vector<RunGroup> run_groups(const ReportData& data, std::size_t limit);

}  // namespace sluice
