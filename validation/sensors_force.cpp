// Forces on faces and bodies, and velocity probes.
#include <fmt/format.h>

#include <stdexcept>

#include "validation/case.h"
#include "validation/sensors.h"

namespace sluice {
namespace {

/// The number that WallParticle::body gives to a body: 0 the tank, 1 + k obstacle k.
int body_number(const Scene& scene, const std::string& body) {
  if (body == "tank") return 0;
  for (std::size_t k = 0; k < scene.fitted.obstacles.size(); ++k)
    if (scene.fitted.obstacles[k].name == body) return static_cast<int>(k) + 1;
  throw std::invalid_argument(fmt::format("the scene has no body named `{}`", body));
}

class ForceSensor : public Sensor {
 public:
  ForceSensor(const CaseSensor& sensor, std::string primary, const Scene& scene)
      : sensor_(sensor),
        primary_(std::move(primary)),
        patch_(wall_patch(scene, sensor.body, sensor.faces)),
        area_m2_(scene.fitted.particle_distance_m * scene.fitted.particle_distance_m) {}

  void append_columns(std::vector<std::string>& names) const override {
    names.push_back(probe_column(sensor_));
    for (const std::string& model : models_of(SensorKind::force)) names.push_back(probe_column(sensor_, model));
  }

  void append_values(const Solver& solver, std::vector<double>& values) const override {
    const double acceleration_N = dot(solver.wall_reaction_N(patch_.behind), sensor_.normal);
    const double pressure_N = dot(pressure_force_N(solver), sensor_.normal);
    values.insert(values.end(), {primary_ == "acceleration" ? acceleration_N : pressure_N, acceleration_N, pressure_N});
  }

  PlacedSensor placed() const override { return {sensor_.name, "force", primary_, {}, {}, 0}; }

 private:
  /// - sum of P A n, with the normal n into the fluid   [N]
  Vec3d pressure_force_N(const Solver& solver) const {
    Vec3d sum;
    for (std::size_t k = 0; k < patch_.first.size(); ++k)
      sum += (-area_m2_ * solver.wall_particle_pressure_Pa(patch_.first[k])) * patch_.first_normal[k];
    return sum;
  }

  CaseSensor sensor_;
  std::string primary_;
  WallPatch patch_;
  double area_m2_;
};

class VelocityProbe : public Sensor {
 public:
  VelocityProbe(const CaseSensor& sensor, std::string primary) : sensor_(sensor), primary_(std::move(primary)) {}

  void append_columns(std::vector<std::string>& names) const override {
    names.push_back(probe_column(sensor_));
    names.push_back(probe_column(sensor_, "kernel"));
    names.push_back(sensor_.name + "_kernel_support_1");
  }

  void append_values(const Solver& solver, std::vector<double>& values) const override {
    const VelocityReading mean = solver.kernel_velocity(sensor_.position_m);
    const double u_m_s = mean.support < minimum_kernel_support ? 0 : dot(mean.velocity_m_s, sensor_.normal);
    values.insert(values.end(), {u_m_s, u_m_s, mean.support});
  }

  PlacedSensor placed() const override {
    return {sensor_.name, "velocity", primary_, sensor_.position_m, sensor_.position_m, 0};
  }

 private:
  CaseSensor sensor_;
  std::string primary_;
};

}  // namespace

WallPatch wall_patch(const Scene& scene, const std::string& body, FaceSet faces) {
  const int number = body_number(scene, body);
  WallPatch patch;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const WallParticle& w = scene.walls[k];
    const auto wall = static_cast<std::int32_t>(k);
    const bool belongs = w.foot_of > 0 ? w.foot_of == number : w.body == number;
    if (belongs && (faces == all_faces || (w.behind_faces & faces) != 0)) patch.behind.push_back(wall);
    if (w.body != number) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upwards : {false, true}) {
        if ((w.on_faces & faces & face_bit(axis, upwards)) == 0) continue;
        Vec3d normal;
        component(normal, axis) = upwards ? 1 : -1;
        patch.first.push_back(wall);
        patch.first_normal.push_back(normal);
      }
  }
  return patch;
}

std::unique_ptr<Sensor> make_force_sensor(const CaseSensor& sensor, const std::string& primary, const Scene& scene) {
  return std::make_unique<ForceSensor>(sensor, primary, scene);
}

std::unique_ptr<Sensor> make_velocity_probe(const CaseSensor& sensor, const std::string& primary) {
  return std::make_unique<VelocityProbe>(sensor, primary);
}

}  // namespace sluice
