// A validation case: everything in validation/cases/*.toml that a run, a comparison or a report needs to know.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/scene.h"
#include "solvers/vec3.h"

namespace sluice {

/// A case file that cannot be used. The message reads `file:line: key: what is wrong (remedy)`.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A face of a body, named by its normal into the fluid: the tank's face x+ is its wall at lower x, an obstacle's the
/// one at upper x. Without an axis: the whole body.
struct BodyFace {
  int axis = -1;
  bool upwards = false;

  bool whole_body() const { return axis < 0; }
};

enum class SensorKind { pressure, wave_height, force, velocity };

/// All of them.
const std::vector<SensorKind>& sensor_kinds();

std::string_view to_string(SensorKind kind);

/// A closed interval of time [s].
struct TimeWindow {
  double start_s = 0;
  double end_s = 0;
};

/// One probe of the experiment.
struct CaseSensor {
  std::string name;  ///< such as "P1"
  SensorKind kind = SensorKind::pressure;
  Vec3d position_m;  ///< wave height: the foot of the probe's vertical line, on the bed; force: not used
  /// Unit vector. Pressure and wave height: into the fluid, away from the wall, or up the probe's line; force and
  /// velocity: the direction of the component that is read.
  Vec3d normal;
  std::string measured;                 ///< name of the measured series in the digest; empty where nothing was measured
  std::string body{};                   ///< force: name of an obstacle, or "tank"
  BodyFace face{};                      ///< force: one face of the body, or the whole body, net of its far side
  std::filesystem::path measured_in{};  ///< its digest, relative to the source root; empty: the case's
  double measured_shift_s = 0;          ///< added to the measured times: what the sources' clock lacks
  bool measured_is_band = false;        ///< the bins' minimum to maximum is the measurement's own scatter
  std::optional<TimeWindow> window{};   ///< of its metrics, where it is not the case's
  std::vector<TimeWindow> impulses_s{};  ///< spans over which reports give its impulse beside that over the window
};

/// "Pa", "m", "N" or "m_s".
std::string_view unit_of(SensorKind kind);

/// The header of a column in probes.csv: `<sensor>[_<model>]_<unit>`; without a model the primary reading.
std::string probe_column(const CaseSensor& sensor, std::string_view model = "");

/// One wall model of a solver: how many particle layers it needs, and which sensor models are the primary readings.
struct WallOption {
  std::string name;  ///< such as "extrapolated"
  int layers = 3;
  std::string pressure_model;                  ///< "wall", "kernel" or "nearest"
  std::string wave_height_model;               ///< "column" or "top"
  std::string force_model{};                   ///< "acceleration" or "pressure"; empty where no force is read
  std::map<std::string, double> parameters{};  ///< where this wall model's defaults differ from the solver's
};

/// The case's defaults for one solver.
struct SolverOption {
  std::string name;           ///< such as "wcsph"
  std::string default_walls;  ///< name of one of `walls`; empty when a solver knows no choice
  std::vector<WallOption> walls;
  std::map<std::string, double> parameters;  ///< numeric solver parameters by name; the solver knows which it takes
};

/// A length of the geometry that a run may choose, such as an obstacle's distance that the sources leave open:
/// obstacles are displaced along a unit vector by as much as the chosen value exceeds the one at which they are drawn.
struct Placement {
  std::string name;  ///< such as "block_distance_m"
  double drawn_m = 0;
  std::vector<std::string> moves;  ///< names of obstacles
  Vec3d along;
};

/// A named resolution at which the case is validated.
struct Tier {
  std::string name;
  double l0_m = 0;
  double t_end_s = 0;
};

/// One acceptance band: a metric's value must lie in [lower, upper] for runs that the row applies to.
struct AcceptanceRow {
  std::string metric;  ///< one of acceptance_metrics()
  std::string sensor;  ///< empty for a quantity of the whole run
  std::string model;   ///< sensor model ("wall", "column"); empty: the primary reading
  std::string solver;
  std::string walls;    ///< empty: every wall model
  double l0_min_m = 0;  ///< the row applies to l0_min_m <= l0 <= l0_max_m ...
  double l0_max_m = 0;
  std::optional<double> alpha;  ///< ... and to this artificial viscosity only, when given
  double lower = 0;
  double upper = 0;
  std::optional<TimeWindow> window{};  ///< of this comparison, where it is not the sensor's
  std::string remark;
  int line = 0;      ///< in the case file, or in `file`
  std::string file;  ///< of add_bands(); empty: the case's own
};

/// Names of the metrics that acceptance rows can use, with what each needs.
struct AcceptanceMetric {
  std::string_view name;
  std::string_view unit;  ///< "s", "1" (relative), "particles", "n0"
  bool needs_sensor = true;
  std::string_view meaning;
};
const std::vector<AcceptanceMetric>& acceptance_metrics();

/// An impulse as printed in the paper. Printed values are kept as they are; `remark` notes misprints.
struct PublishedImpulse {
  std::string sensor;
  std::string source;           ///< "experiment", "wcsph" or "mps"
  std::optional<double> alpha;  ///< wcsph only
  double impulse_Pa_s = 0;
  std::optional<double> deviation_percent;  ///< unsigned, as printed
};

/// A computation as printed in the paper's table of parameters and processing times.
struct PublishedRun {
  std::string solver;
  double l0_m = 0;
  double radius_over_l0 = 0;
  std::vector<double> alpha;  ///< wcsph: as many as `viscosity_m2_s`
  std::vector<double> viscosity_m2_s;
  double fluid_particles = 0;
  double solid_particles = 0;
  double t_end_s = 0;
  double dt_s = 0;
  double cpu_time_s = 0;
  std::optional<double> gpu_time_s;
  std::string remark;
};

/// Which figure of the paper shows a sensor.
struct PublishedFigure {
  int number = 0;
  std::string sensor;
};

struct Published {
  std::string reference;  ///< of the paper
  std::vector<PublishedImpulse> impulses;
  int impulses_table = 0;
  std::vector<PublishedRun> runs;
  int runs_table = 0;
  std::vector<PublishedFigure> figures;
  int snapshots_figure = 0;
  std::optional<double> snapshots_alpha{};    ///< of the WCSPH in that figure
  std::optional<double> snapshots_l0_m{};     ///< of all that it shows   [m]
  std::string snapshots_colour = "pressure";  ///< of particles in reports: "pressure" or "velocity", dimensionless
  int geometry_figure = 0;
  std::string cpu;  ///< the machine of the printed CPU times
  std::string gpu;
};

struct Case {
  std::string name;
  std::string title;
  std::string reference;                 ///< of the experiment
  std::vector<std::string> assumptions;  ///< what the sources leave open, in words; every report repeats them
  std::filesystem::path file;            ///< where it was read from
  std::string hash;                      ///< of the file's bytes, as file_hash() gives
  std::string computed_hash{};           ///< of the inputs alone, see computed_hash.h

  Box tank;  ///< inner faces [m]
  std::vector<Box> fluid;
  std::vector<Obstacle> obstacles;
  std::vector<Placement> placements;
  Vec3d gravity_m_s2;
  double water_height_m = 0;  ///< H_W: scale of c0 = 20 sqrt(g H_W) and of the dimensionless pressure
  double density_kg_m3 = 0;

  std::vector<CaseSensor> sensors;
  std::filesystem::path measured;  ///< digest of the measured series, relative to the source root; may not exist
  TimeWindow window;               ///< of impulses and RMSE
  double t_end_s = 0;
  double output_rate_Hz = 1000;
  std::vector<double> snapshot_times_s;

  std::string default_solver;
  std::vector<SolverOption> solvers;
  std::vector<Tier> tiers;
  std::vector<AcceptanceRow> acceptance;
  Published published;

  /// nullptr when there is none of that name.
  const Placement* find_placement(std::string_view placement_name) const;
  const CaseSensor* find_sensor(std::string_view sensor_name) const;
  const SolverOption* find_solver(std::string_view solver_name) const;
  const Tier* find_tier(std::string_view tier_name) const;

  /// Over which a sensor is compared: its own or the case's.
  TimeWindow window_of(const CaseSensor& sensor) const { return sensor.window.value_or(window); }
  /// The digest of a sensor's measured series; empty when nothing was measured.
  const std::filesystem::path& measured_file(const CaseSensor& sensor) const;
};

/// nullptr when the solver has no wall model of that name.
const WallOption* find_walls(const SolverOption& solver, std::string_view walls);

/// The models that can read a kind of sensor.
const std::vector<std::string>& models_of(SensorKind kind);

/// The sensor model of the primary reading ("wall", "kernel", "nearest", "column", "top", "acceleration").
/// Throws std::invalid_argument when the case does not know the solver or its wall model.
std::string primary_model(const Case& c, const CaseSensor& sensor, std::string_view solver, std::string_view walls);

/// What is wrong with a particle distance [m] for this case, with the largest that would do; empty when it will do.
/// Every obstacle and the deepest body of fluid must be at least three particles across, thin obstacles apart.
std::string particle_distance_problem(const Case& c, double l0_m);

/// Displaces those of the obstacles, which stand as drawn, that a placement moves to its value [m].
void place(std::vector<Obstacle>& obstacles, const Placement& placement, double value_m);

/// The case's geometry for one particle distance [m] and number of wall layers.
SceneDescription scene_description(const Case& c, double l0_m, int wall_layers);

/// Reads a case by name ("kleefsman": validation/cases/kleefsman.toml under case_directory()) or by the path of its
/// TOML file. Throws CaseError; for an unknown name the message lists those that exist.
Case load_case(const std::string& name_or_path);

/// Whether a run or checkpoint that tells these hashes was computed from the inputs that the case has now.
/// `computed_hash` is empty where it is not told, as by older ones: then the file must be the same, byte for byte.
bool has_inputs_of(const Case& c, std::string_view computed_hash, std::string_view hash);

/// Adds the acceptance rows of a file of their own, for a solver that the case need not know: [[acceptance]] groups as
/// in a case file, where `walls`, `alpha` and `l0_m` may be left out. Throws CaseError naming file, line and key.
void add_bands(Case& c, const std::filesystem::path& file);

/// The absolute path of a case that is none of the project's own; empty for those, which are found by their names.
std::string outside_case_file(const Case& c);

/// Reads a case from text; `file` is what messages call it.
Case parse_case(std::string_view text, const std::string& file);

/// Where named cases live: validation/cases below the working directory, or else below the source tree of this build.
std::filesystem::path case_directory();

/// Names of all cases in case_directory(), sorted.
std::vector<std::string> case_names();

/// Resolves a path relative to the source root (the digest of a case) against the working directory or else the source
/// tree of this build, whichever has it; returns it unchanged when neither has.
std::filesystem::path resolve_in_source_tree(const std::filesystem::path& path);

}  // namespace sluice
