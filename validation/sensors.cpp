#include "validation/sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "validation/case.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

constexpr double inside = 0.5;  // volume fraction at a plane free surface
constexpr double face_tolerance_m = 1e-3;

// The levels of a probe's line: level k stands k l0/2 above the bed.
class LineScan {
 public:
  LineScan(const Solver& solver, const ProbeLine& line)
      : solver_(solver),
        line_(line),
        step_(line.particle_distance_m / 2),
        last_(static_cast<int>(std::ceil((line.top_z_m - line.bed_z_m) / step_))) {}

  double column() const {
    const int reach = static_cast<int>(2 * line_.smoothing_length_m / step_);
    for (int k = 0; k <= std::min(reach, last_); ++k)
      if (fraction(k) >= inside) return surface_above(k);
    return 0;
  }

  double top() const {
    // With not a particle within 2h of a level, none lies within h of levels closer than h, and the shell beyond that
    // holds 31 % of the kernel's weight: too little for one half.
    const int empty_reach = std::max(1, static_cast<int>(line_.smoothing_length_m / step_));
    for (int k = last_; k >= 0;) {
      const double f = fraction(k);
      if (f >= inside) return surface_above(k);
      k -= f > 0 ? 1 : empty_reach;
    }
    return 0;
  }

 private:
  double fraction(int k) const { return mirrored_fraction(solver_, line_, line_.bed_z_m + k * step_); }

  // The first crossing above a level that is inside fluid, as a height above the bed.
  double surface_above(int k) const {
    double below = fraction(k);
    for (; k < last_; ++k) {
      const double above = fraction(k + 1);
      if (above < inside) return (k + (below - inside) / (below - above)) * step_;
      below = above;
    }
    return last_ * step_;
  }

  const Solver& solver_;
  const ProbeLine& line_;
  double step_;
  int last_;
};

// The coordinate on `axis` of the fitted face that belongs to a nominal face of this box, if the point lies on it.
std::optional<double> fitted_face(const Box& nominal, const Box& fitted, const Vec3d& p, int axis, bool upper) {
  for (int other = 0; other < 3; ++other) {
    if (other == axis) continue;
    if (component(p, other) < component(nominal.lower, other) - face_tolerance_m) return std::nullopt;
    if (component(p, other) > component(nominal.upper, other) + face_tolerance_m) return std::nullopt;
  }
  const double face = component(upper ? nominal.upper : nominal.lower, axis);
  if (std::abs(component(p, axis) - face) > face_tolerance_m) return std::nullopt;
  return component(upper ? fitted.upper : fitted.lower, axis);
}

bool covers(const Box& box, const Vec3d& p) {
  return p.x >= box.lower.x && p.x <= box.upper.x && p.y >= box.lower.y && p.y <= box.upper.y;
}

class PressureSensor : public Sensor {
 public:
  PressureSensor(CaseSensor sensor, std::string primary, std::string wall_model, const Scene& scene,
                 double smoothing_length_m)
      : sensor_(std::move(sensor)),
        primary_(std::move(primary)),
        wall_model_(std::move(wall_model)),
        face_m_(on_fitted_face(scene, sensor_.position_m, sensor_.normal)),
        offset_m_(smoothing_length_m) {}

  void append_columns(std::vector<std::string>& names) const override {
    names.push_back(probe_column(sensor_));
    names.push_back(probe_column(sensor_, wall_model_));
    names.push_back(probe_column(sensor_, "kernel"));
    names.push_back(sensor_.name + "_kernel_support_1");
  }

  void append_values(const Solver& solver, std::vector<double>& values) const override {
    const double wall = solver.wall_pressure(face_m_).pressure_Pa;
    const PressureReading mean = solver.kernel_pressure(face_m_ + offset_m_ * sensor_.normal);
    const double kernel = mean.support < minimum_kernel_support ? 0 : mean.pressure_Pa;
    values.insert(values.end(), {primary_ == "kernel" ? kernel : wall, wall, kernel, mean.support});
  }

  PlacedSensor placed() const override {
    return {sensor_.name, "pressure", primary_, sensor_.position_m, face_m_, offset_m_};
  }

 private:
  CaseSensor sensor_;
  std::string primary_;
  std::string wall_model_;  ///< what the solver's wall pressure is
  Vec3d face_m_;
  double offset_m_;
};

class WaveHeightSensor : public Sensor {
 public:
  WaveHeightSensor(CaseSensor sensor, std::string primary, const Scene& scene, double smoothing_length_m)
      : sensor_(std::move(sensor)), primary_(std::move(primary)) {
    line_.x_m = sensor_.position_m.x;
    line_.y_m = sensor_.position_m.y;
    line_.bed_z_m = scene.fitted.tank.lower.z;
    for (const Obstacle& obstacle : scene.fitted.obstacles)
      if (!obstacle.motion.moves() && covers(obstacle.box, sensor_.position_m))
        line_.bed_z_m = std::max(line_.bed_z_m, obstacle.box.upper.z);
    line_.top_z_m = scene.fitted.tank.upper.z;
    line_.particle_distance_m = scene.fitted.particle_distance_m;
    line_.smoothing_length_m = smoothing_length_m;
  }

  void append_columns(std::vector<std::string>& names) const override {
    names.push_back(probe_column(sensor_));
    names.push_back(probe_column(sensor_, "column"));
    names.push_back(probe_column(sensor_, "top"));
  }

  void append_values(const Solver& solver, std::vector<double>& values) const override {
    const WaveHeights h = wave_heights(solver, line_);
    values.insert(values.end(), {primary_ == "column" ? h.column_m : h.top_m, h.column_m, h.top_m});
  }

  PlacedSensor placed() const override {
    return {sensor_.name, "wave_height", primary_, sensor_.position_m, {line_.x_m, line_.y_m, line_.bed_z_m}, 0};
  }

 private:
  CaseSensor sensor_;
  std::string primary_;
  ProbeLine line_;
};

void require_model(const CaseSensor& sensor, const std::string& primary,
                   std::initializer_list<std::string_view> known) {
  if (std::find(known.begin(), known.end(), primary) == known.end())
    throw std::invalid_argument(fmt::format("sensor {}: unknown model '{}' for its primary reading; known are {}",
                                            sensor.name, primary, fmt::join(known, " and ")));
}

std::unique_ptr<Sensor> make_sensor(const CaseSensor& sensor, const std::string& primary, const std::string& wall_model,
                                    const Scene& scene, double h) {
  switch (sensor.kind) {
    case SensorKind::pressure:
      require_model(sensor, primary, {wall_model, "kernel"});
      return std::make_unique<PressureSensor>(sensor, primary, wall_model, scene, h);
    case SensorKind::wave_height:
      require_model(sensor, primary, {"column", "top"});
      return std::make_unique<WaveHeightSensor>(sensor, primary, scene, h);
    case SensorKind::force:
      require_model(sensor, primary, {"acceleration", "pressure"});
      return make_force_sensor(sensor, primary, scene);
    case SensorKind::velocity:
      return make_velocity_probe(sensor, primary);
  }
  throw std::invalid_argument(fmt::format("sensor {}: its kind cannot be read from a solver", sensor.name));
}

}  // namespace

double mirrored_fraction(const Solver& solver, const ProbeLine& line, double z_m) {
  double f = solver.volume_fraction({line.x_m, line.y_m, z_m});
  if (z_m - line.bed_z_m < 2 * line.smoothing_length_m)
    f += solver.volume_fraction({line.x_m, line.y_m, 2 * line.bed_z_m - z_m});
  return f;
}

WaveHeights wave_heights(const Solver& solver, const ProbeLine& line) {
  const LineScan scan(solver, line);
  return {scan.column(), scan.top()};
}

Vec3d on_fitted_face(const Scene& scene, const Vec3d& position_m, const Vec3d& normal) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(component(normal, other)) > std::abs(component(normal, axis))) axis = other;
  const bool positive = component(normal, axis) > 0;

  const SceneDescription& nominal = scene.description;
  const SceneDescription& fitted = scene.fitted;
  // An obstacle's normals point out of its box, the tank's into it.
  std::optional<double> face = fitted_face(nominal.tank, fitted.tank, position_m, axis, !positive);
  for (std::size_t i = 0; !face && i < nominal.obstacles.size(); ++i)
    face = fitted_face(nominal.obstacles[i].box, fitted.obstacles[i].box, position_m, axis, positive);
  Vec3d placed = position_m;
  if (face) component(placed, axis) = *face;
  return placed;
}

namespace {

// What no position belongs to: energies of the fluid, and its densest particle.
constexpr std::array<std::string_view, 3> totals_columns{"kinetic_energy_J", "potential_energy_J",
                                                         "greatest_density_ratio_1"};

void append_totals(const FluidTotals& totals, std::vector<double>& values) {
  values.insert(values.end(), {totals.kinetic_energy_J, totals.potential_energy_J, totals.greatest_density_ratio});
}

}  // namespace

SensorArray::SensorArray(const Case& the_case, const Scene& scene, double smoothing_length_m, std::string_view solver,
                         std::string_view walls) {
  for (const CaseSensor& sensor : the_case.sensors)
    sensors_.push_back(make_sensor(sensor, primary_model(the_case, sensor, solver, walls), wall_pressure_model(solver),
                                   scene, smoothing_length_m));
}

std::vector<std::string> SensorArray::columns() const {
  std::vector<std::string> names;
  for (const auto& sensor : sensors_) sensor->append_columns(names);
  names.insert(names.end(), totals_columns.begin(), totals_columns.end());
  return names;
}

void SensorArray::sample(const Solver& solver, std::vector<double>& values) const {
  values.clear();
  for (const auto& sensor : sensors_) sensor->append_values(solver, values);
  append_totals(solver.totals(), values);
}

std::vector<PlacedSensor> SensorArray::placed() const {
  std::vector<PlacedSensor> all;
  for (const auto& sensor : sensors_) all.push_back(sensor->placed());
  return all;
}

}  // namespace sluice
