// The sensors of a case, read from a running solver by one or more models each.
//
// Pressure, model `kernel`: the fluid's kernel mean at a point one smoothing length h off the wall; zero where there is
//   less fluid than minimum_kernel_support of the kernel. Its support is recorded beside it.
// Pressure, model `wall`: mean pressure of the first layer's wall particles within h of the sensor.
// Pressure, model `nearest` (in the place of `wall`, for a solver whose walls have pressures of their own; which of the
//   two a solver has is wall_pressure_model()): the raw pressure of the wall particle nearest to the sensor.
// Wave height, model `column`: the level of the first gap counted from the bed upwards.
// Wave height, model `top`: the highest level on the probe's line that is inside fluid, spray included.
// Velocity, model `kernel`: the fluid's kernel mean of one component at a point; zero where there is too little fluid,
//   as above.
// Force, model `acceleration`: mass times the acceleration that the fluid would give to the wall particles behind the
//   chosen faces, in a direction (the paper's reading of WCSPH); those of the tank under the body stand in for its
//   foot.
// Force, model `pressure`: pressure of the faces' first-layer particles times l0^2, in the same direction (the paper's
//   reading of MPS). Where a solver's walls act behind their faces (Solver::wall_setback_m), a face that stands on the
//   floor goes down by so much: the floor's particles in its plane take part with that share of l0.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/scene.h"
#include "solvers/solver.h"
#include "solvers/vec3.h"

namespace sluice {

struct BodyFace;
struct Case;
struct CaseSensor;

/// A kernel mean counts from this share of the kernel's support on: what one particle one l0 off the point fills (0.057
/// with 2h = 3 l0). Not higher, since near the bed dynamic walls hold fluid off from two sides: P1 of the Kleefsman
/// case has a support of 0.15 to 0.35 in full flow at l0 = 0.04 m.
inline constexpr double minimum_kernel_support = 0.05;

/// A vertical line on which a wave height is read.
struct ProbeLine {
  double x_m = 0;
  double y_m = 0;
  double bed_z_m = 0;              ///< the tank's floor, or the top of the obstacle under the probe
  double top_z_m = 0;              ///< where the search ends
  double particle_distance_m = 0;  ///< l0, the scale of the search
  double smoothing_length_m = 0;   ///< h; the kernel ends at 2h
};

/// Heights above the bed [m]. Zero on a dry bed.
struct WaveHeights {
  double column_m = 0;
  double top_m = 0;
};

/// Fluid's volume fraction at a height of the line, with the fluid mirrored about the bed: near the bed half of the
/// kernel's support lies in the floor, where there is no fluid, and a filled tank would read one half there. So
/// fraction(z) + fraction(2 bed - z) within 2h of the bed. It may come out a little over 1.
double mirrored_fraction(const Solver& solver, const ProbeLine& line, double z_m);

/// Both models of the wave height: one-half crossings of the mirrored fraction, interpolated between levels l0/2 apart.
/// A column stands on the bed if its lowest fluid lies within 2h of it: walls may hold fluid off by about h.
WaveHeights wave_heights(const Solver& solver, const ProbeLine& line);

/// Moves a point on a nominal face of the tank or of an obstacle along its normal onto the same face as fitted to the
/// lattice. A point that lies on no face (to 1 mm) stays where it is.
Vec3d on_fitted_face(const Scene& scene, const Vec3d& position_m, const Vec3d& normal);

/// One sensor as placed in the scene, for the manifest.
struct PlacedSensor {
  std::string name;
  std::string kind;     ///< as to_string(SensorKind) gives it
  std::string primary;  ///< the model repeated in the plain column
  Vec3d position_m;     ///< as the case gives it
  Vec3d placed_m;       ///< on the fitted geometry: a pressure sensor on its fitted face, a probe's foot on its bed
  double offset_m = 0;  ///< kernel model: distance of the reading point from the face; 0 for others
};

/// One sensor: the columns it fills and how it reads them.
class Sensor {
 public:
  virtual ~Sensor() = default;
  virtual void append_columns(std::vector<std::string>& names) const = 0;
  virtual void append_values(const Solver& solver, std::vector<double>& values) const = 0;
  virtual PlacedSensor placed() const = 0;
};

/// All sensors of a case in the case's order. Readings are taken on the fitted geometry. For a pressure sensor P1:
/// P1_Pa (the primary model), P1_wall_Pa, P1_kernel_Pa, P1_kernel_support_1; for a wave probe H1: H1_m (the primary
/// model), H1_column_m, H1_top_m; for a force F: F_N, F_acceleration_N, F_pressure_N; for a velocity probe U: U_m_s,
/// U_kernel_m_s, U_kernel_support_1. After them, for every case: kinetic_energy_J, potential_energy_J,
/// greatest_density_ratio_1 (solvers/solver.h).
class SensorArray {
 public:
  /// Places the case's sensors in the scene. `solver` and `walls` choose the primary models (such as "wcsph",
  /// "extrapolated"). Throws std::invalid_argument naming a sensor whose kind or model is unknown.
  SensorArray(const Case& the_case, const Scene& scene, double smoothing_length_m, std::string_view solver,
              std::string_view walls);

  /// Names of the columns of probes.csv, without the leading t_s.
  std::vector<std::string> columns() const;
  /// Reads every sensor; `values` is overwritten and in the order of columns().
  void sample(const Solver& solver, std::vector<double>& values) const;
  std::vector<PlacedSensor> placed() const;

 private:
  std::vector<std::unique_ptr<Sensor>> sensors_;
};

/// The wall particles of which a force is the sum, as places in Scene::walls.
struct WallPatch {
  std::vector<std::int32_t> behind;  ///< of all layers, back to a plane behind the face; the body's foot among them
  /// What is cut off there is cut off for the fluid too: around the body's edges fluid behind the plane pushes
  /// particles before it and the other way about, and only without both is the sum the pressure times the face's area.
  Box fluid_within_m;
  std::vector<std::int32_t> first;  ///< first-layer particles, once for each face on which they lie
  std::vector<Vec3d> first_normal;  ///< normals into the fluid, as many
  /// The floor's particles in line with the faces' columns, for solvers whose floor lies lower than it is drawn.
  std::vector<std::int32_t> foot;
  std::vector<Vec3d> foot_normal;
};
/// `body` is an obstacle's name or "tank". Throws std::invalid_argument when the scene has no such body.
WallPatch wall_patch(const Scene& scene, const std::string& body, const BodyFace& face);

std::unique_ptr<Sensor> make_force_sensor(const CaseSensor& sensor, const std::string& primary, const Scene& scene);
std::unique_ptr<Sensor> make_velocity_probe(const CaseSensor& sensor, const std::string& primary);

}  // namespace sluice
