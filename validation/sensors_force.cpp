// Forces on faces and bodies, and velocity probes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

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

/// Which wall particles belong to a body and to its faces.
class BodyGeometry {
 public:
  BodyGeometry(const Scene& scene, int number)
      : tank_(scene.fitted.tank),
        number_(number),
        box_(number == 0 ? tank_ : scene.fitted.obstacles[static_cast<std::size_t>(number) - 1].box),
        stands_(number > 0 && box_.lower.z <= tank_.lower.z + tolerance(scene)),
        l0_(scene.fitted.particle_distance_m),
        layers_(scene.fitted.wall_layers) {}

  /// The body's own particles, and those of the floor under it: its foot, which keeps the fluid beside it in place as
  /// the body itself would if it went on into the floor.
  bool owns(const WallParticle& w) const {
    if (w.body == number_) return true;
    return w.body == 0 && stands_ && w.position.z < tank_.lower.z && over_footprint(w.position);
  }

  /// All of space, or what lies before a plane as far behind the face as its layers reach, at most half-way through.
  Box fluid_before_cut(const BodyFace& face) const {
    constexpr double far = 1e9;
    Box region{{-far, -far, -far}, {far, far, far}};
    if (face.whole_body()) return region;
    const double thickness = component(box_.upper, face.axis) - component(box_.lower, face.axis);
    const double depth = number_ == 0 ? layers_ * l0_ : std::min(layers_ * l0_, 0.5 * thickness);
    const double plane = face_m(face.axis, face.upwards);
    component(face.upwards ? region.lower : region.upper, face.axis) = face.upwards ? plane - depth : plane + depth;
    return region;
  }

  /// Whether a particle of the body lies behind a face, the tank's other walls apart.
  bool behind(const WallParticle& w, const BodyFace& face) const {
    return face.whole_body() || depth_behind(w, face.axis, face.upwards) > 0;
  }

  /// Whether a particle is one of the squares that tile a face.
  bool on_face(const WallParticle& w, int axis, bool upwards) const {
    return w.body == number_ && in_first_layer(w, axis, upwards) && (number_ > 0 || sides_left(w.position) == 1);
  }

  /// Whether a particle of the floor is in line with the first layer of an upright face that stands on it.
  bool at_foot(const WallParticle& w, int axis, bool upwards) const {
    const bool in_floor = w.body == 0 && w.layer == 0 && w.position.z < tank_.lower.z;
    if (axis == 2 || !in_floor || !in_first_layer(w, axis, upwards)) return false;
    return number_ == 0 ? sides_left(w.position) == 2 : stands_ && over_footprint(w.position);
  }

 private:
  static double tolerance(const Scene& scene) { return 0.25 * scene.fitted.particle_distance_m; }
  /// The tank's faces look inwards.
  double face_m(int axis, bool upwards) const {
    return component(upwards == (number_ > 0) ? box_.upper : box_.lower, axis);
  }
  bool over_footprint(const Vec3d& p) const {
    return p.x > box_.lower.x && p.x < box_.upper.x && p.y > box_.lower.y && p.y < box_.upper.y;
  }
  double depth_behind(const WallParticle& w, int axis, bool upwards) const {
    return (upwards ? 1 : -1) * (face_m(axis, upwards) - component(w.position, axis));
  }
  bool in_first_layer(const WallParticle& w, int axis, bool upwards) const {
    return std::abs(depth_behind(w, axis, upwards) - 0.5 * l0_) < 0.25 * l0_;
  }
  /// Beyond how many pairs of the box's sides a point lies.
  int sides_left(const Vec3d& p) const {
    int left = 0;
    for (int a = 0; a < 3; ++a)
      left += component(p, a) < component(box_.lower, a) || component(p, a) > component(box_.upper, a);
    return left;
  }

  Box tank_;
  int number_;
  Box box_;
  bool stands_;
  double l0_;
  double layers_;
};

class ForceSensor : public Sensor {
 public:
  ForceSensor(const CaseSensor& sensor, std::string primary, const Scene& scene)
      : sensor_(sensor),
        primary_(std::move(primary)),
        patch_(wall_patch(scene, sensor.body, sensor.face)),
        l0_m_(scene.fitted.particle_distance_m) {}

  void append_columns(std::vector<std::string>& names) const override {
    names.push_back(probe_column(sensor_));
    for (const std::string& model : models_of(SensorKind::force)) names.push_back(probe_column(sensor_, model));
  }

  void append_values(const Solver& solver, std::vector<double>& values) const override {
    const Vec3d foot_N = foot_force_N(solver);
    const Vec3d reaction_N = solver.wall_reaction_N(patch_.behind, patch_.fluid_within_m);
    const double acceleration_N = dot(reaction_N + foot_N, sensor_.normal);
    const double pressure_N = dot(pressure_force_N(solver) + foot_N, sensor_.normal);
    values.insert(values.end(), {primary_ == "acceleration" ? acceleration_N : pressure_N, acceleration_N, pressure_N});
  }

  PlacedSensor placed() const override { return {sensor_.name, "force", primary_, {}, {}, 0}; }

 private:
  /// - sum of P A n, with the normal n into the fluid   [N]
  Vec3d pressure_force_N(const Solver& solver) const {
    Vec3d sum;
    for (std::size_t k = 0; k < patch_.first.size(); ++k)
      sum += (-l0_m_ * l0_m_ * solver.wall_particle_pressure_Pa(patch_.first[k])) * patch_.first_normal[k];
    return sum;
  }

  /// What the floor's particles pass on sideways where the water of the equations ends inside them: of both routes,
  /// whose sums begin at the lowest fluid   [N]
  Vec3d foot_force_N(const Solver& solver) const {
    Vec3d sum;
    const double setback_m = solver.wall_setback_m();
    if (setback_m == 0) return sum;
    for (std::size_t k = 0; k < patch_.foot.size(); ++k)
      sum += (-l0_m_ * setback_m * solver.wall_particle_pressure_Pa(patch_.foot[k])) * patch_.foot_normal[k];
    return sum;
  }

  CaseSensor sensor_;
  std::string primary_;
  WallPatch patch_;
  double l0_m_;
};

class VelocityProbe : public Sensor {
 public:
  VelocityProbe(CaseSensor sensor, std::string primary) : sensor_(std::move(sensor)), primary_(std::move(primary)) {}

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

WallPatch wall_patch(const Scene& scene, const std::string& body, const BodyFace& face) {
  const BodyGeometry geometry(scene, body_number(scene, body));
  WallPatch patch;
  patch.fluid_within_m = geometry.fluid_before_cut(face);
  const auto add_face = [&](const WallParticle& w, std::int32_t wall, int axis, bool upwards) {
    Vec3d normal;
    component(normal, axis) = upwards ? 1 : -1;
    if (geometry.on_face(w, axis, upwards)) {
      patch.first.push_back(wall);
      patch.first_normal.push_back(normal);
    } else if (geometry.at_foot(w, axis, upwards)) {
      patch.foot.push_back(wall);
      patch.foot_normal.push_back(normal);
    }
  };
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const WallParticle& w = scene.walls[k];
    const auto wall = static_cast<std::int32_t>(k);
    if (geometry.owns(w) && geometry.behind(w, face) && holds_point(patch.fluid_within_m, w.position))
      patch.behind.push_back(wall);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upwards : {false, true})
        if (face.whole_body() || (face.axis == axis && face.upwards == upwards)) add_face(w, wall, axis, upwards);
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
