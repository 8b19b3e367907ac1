// Known answers: the operators on fields whose gradient and Laplacian are known, a tank at rest, a standing wave.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "solvers/mps/mps_solver.h"
#include "solvers/mps/test_tank.h"

namespace sluice::mps {
namespace {

using Field = std::function<double(const Vec3d&)>;

/// The operators on a cube of particles, evaluated well inside it. The field is taken about the cube's middle.
struct Operators {
  Operators(double l0, double jitter)
      : p(parameters_for(l0, 5)),
        solver(free_particles(l0, jittered_cube(l0, 12, jitter)), p, 1),
        particles(solver.particles()),
        middle{20 * l0, 20 * l0, 20 * l0} {
    p.viscosity_m2_s = 1;
    p.gravity_m_s2 = {0, 0, 0};
    constants = {p, lattice_constants(l0, p.effective_radius_m(), p.effective_radius_m()), 1.0, 1.0};
  }

  bool is_inside(std::size_t i) const {
    const Vec3d d = particles.position.at<double>(i) - middle;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 2.5 * p.particle_distance_m;
  }

  template <class Error>
  double rms(Error&& error) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
      if (!is_inside(i)) continue;
      const double e = error(i);
      sum += e * e;
      ++count;
    }
    return std::sqrt(sum / count);
  }

  double gradient_error(const Field& field, const std::function<Vec3d(const Vec3d&)>& exact) {
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
      particles.pressure[i] = field(particles.position.at<double>(i) - middle);
    return rms([&](std::size_t i) {
      bool plain = false;
      const Vec3d e = pressure_gradient(particles, solver.neighbours(), constants, i, plain) -
                      exact(particles.position.at<double>(i) - middle);
      return std::sqrt(dot(e, e));
    });
  }

  double laplacian_error(const Field& field, const Field& exact) {
    VectorField<double> result;
    result.resize(particles.size());
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
      particles.velocity.set(i, Vec3d{field(particles.position.at<double>(i) - middle), 0, 0});
    predict_velocities(particles, solver.neighbours(), constants, result, 1);
    return rms([&](std::size_t i) {
      return result.x[i] - particles.velocity.x[i] - exact(particles.position.at<double>(i) - middle);
    });
  }

  Parameters p;
  MpsSolver<double> solver;
  Particles<double> particles;
  OperatorConstants constants;
  Vec3d middle;
};

double wave(const Vec3d& r) {
  return std::sin(3 * r.x + 0.5) * std::cos(2 * r.y) + r.z;
}
Vec3d wave_gradient(const Vec3d& r) {
  return {3 * std::cos(3 * r.x + 0.5) * std::cos(2 * r.y), -2 * std::sin(3 * r.x + 0.5) * std::sin(2 * r.y), 1};
}
double wave_laplacian(const Vec3d& r) {
  return -13 * std::sin(3 * r.x + 0.5) * std::cos(2 * r.y);
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(MpsOperators, GradientOnALatticeIsOfSecondOrder) {
  const double coarse = Operators(0.04, 0).gradient_error(wave, wave_gradient);
  const double fine = Operators(0.02, 0).gradient_error(wave, wave_gradient);
  RecordProperty("order", fmt::format("{:.2f}", order(coarse, fine)));
  EXPECT_NEAR(order(coarse, fine), 2, 0.2);
}

/// With the least pressure as reference the error on a disordered lattice is of the gradient's own size, however fine
/// it is: the price of forces that only repel.
TEST(MpsOperators, GradientOnAJitteredLatticeIsOfOrderZero) {
  const double coarse = Operators(0.04, 0.1).gradient_error(wave, wave_gradient);
  const double fine = Operators(0.02, 0.1).gradient_error(wave, wave_gradient);
  RecordProperty("order", fmt::format("{:.2f}", order(coarse, fine)));
  EXPECT_NEAR(order(coarse, fine), 0, 0.3);
  EXPECT_LT(fine, 1.5);
}

/// What is listed beyond the effective radius, so that lists outlive a small displacement, must not be felt.
TEST(MpsOperators, GradientDoesNotSeeBeyondTheEffectiveRadius) {
  Operators o(0.02, 0.1);
  int seen = 0;
  for (std::size_t i = o.particles.first_fluid(); i < o.particles.size(); ++i) {
    const auto& far = o.solver.neighbours().far();
    const Span span = far.span(i);
    bool plain = false;
    const Vec3d before = pressure_gradient(o.particles, o.solver.neighbours(), o.constants, i, plain);
    for (std::uint32_t k = span.begin; k < span.end; ++k) {
      const auto j = static_cast<std::size_t>(far.columns()[k]);
      if (far.values()[k] > 0 || j == i) continue;
      o.particles.pressure[j] = -1e6;
      EXPECT_EQ(pressure_gradient(o.particles, o.solver.neighbours(), o.constants, i, plain), before) << i << " " << j;
      o.particles.pressure[j] = 0;
      ++seen;
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(MpsOperators, GradientOfALinearFieldIsExactOnALattice) {
  const double error = Operators(0.02, 0).gradient_error([](const Vec3d& r) { return 3 * r.x - r.y + 0.5 * r.z; },
                                                         [](const Vec3d&) {
                                                           return Vec3d{3, -1, 0.5};
                                                         });
  EXPECT_LT(error, 1e-9);
}

TEST(MpsOperators, LaplacianOnALatticeIsOfSecondOrder) {
  const double coarse = Operators(0.04, 0).laplacian_error(wave, wave_laplacian);
  const double fine = Operators(0.02, 0).laplacian_error(wave, wave_laplacian);
  RecordProperty("order", fmt::format("{:.2f}", order(coarse, fine)));
  EXPECT_NEAR(order(coarse, fine), 2, 0.2);
}

/// An offset of the neighbourhood's centroid brings the gradient into the Laplacian, divided by a length: on a
/// disordered lattice the error grows as it is refined.
TEST(MpsOperators, LaplacianOnAJitteredLatticeDoesNotConverge) {
  const double coarse = Operators(0.04, 0.1).laplacian_error(wave, wave_laplacian);
  const double fine = Operators(0.02, 0.1).laplacian_error(wave, wave_laplacian);
  RecordProperty("order", fmt::format("{:.2f}", order(coarse, fine)));
  EXPECT_NEAR(order(coarse, fine), -1, 0.3);
}

/// Mean pressure [Pa] of the wall particles under the middle of the bottom.
double bottom_pressure(const MpsSolver<FloatPack>& solver, double side_m) {
  const auto& p = solver.particles();
  double sum = 0;
  int count = 0;
  for (std::size_t i = p.first_wall(); i < p.first_fluid(); ++i) {
    const Vec3d x = p.position.at<double>(i) - Vec3d{0.5 * side_m, 0.5 * side_m, 0};
    if (x.z > 0 || std::max(std::abs(x.x), std::abs(x.y)) > 0.25 * side_m) continue;
    sum += p.pressure[i];
    ++count;
  }
  return sum / count;
}

double kinetic_energy_per_mass(const Particles<FloatPack>& p) {
  double energy = 0;
  for (std::size_t i = p.first_fluid(); i < p.size(); ++i)
    energy += 0.5 * dot(p.velocity.at<double>(i), p.velocity.at<double>(i));
  return energy / static_cast<double>(p.fluid);
}

/// Twenty particles deep. The bottom's pressure rings with the source term's own period of about 63 steps; means over
/// half a second say what it is and whether it drifts. It is measured to lie below rho g depth by what 0.4 l0 of water
/// weigh: 2 % here, 4 % with ten particles. Where the rest goes is not known: wall and surface are n l0 apart.
TEST(MpsVerification, HydrostaticTankForFiveSeconds) {
  const double l0 = 0.02;
  const double depth = 20 * l0;
  const double side = 8 * l0;
  MpsSolver<FloatPack> solver(tank_with_block(l0, {side, side, 0.6}, {side, side, depth}), parameters_for(l0, 5), 2);
  std::vector<double> means;
  double sum = 0;
  int count = 0;
  double greatest_energy = 0;
  while (solver.time_s() < 5) {
    solver.step();
    sum += bottom_pressure(solver, side);
    ++count;
    if (solver.time_s() > 1) greatest_energy = std::max(greatest_energy, kinetic_energy_per_mass(solver.particles()));
    if (solver.time_s() < 0.5 * static_cast<double>(means.size() + 1)) continue;
    means.push_back(sum / count);
    sum = 0;
    count = 0;
  }
  for (std::size_t k = 2; k < means.size(); ++k) EXPECT_NEAR(means[k] / (9810 * depth), 1, 0.03) << "half second " << k;
  EXPECT_NEAR(means.back() / means[2], 1, 0.01) << "drift";
  EXPECT_LT(greatest_energy, 0.5 * 0.1 * 0.1) << "mean kinetic energy a mass [J/kg]";
  EXPECT_EQ(solver.lost().through_walls + solver.lost().over_top, 0);
  RecordProperty("bottom_pressure_over_hydrostatic", fmt::format("{:.4f}", means.back() / (9810 * depth)));
  RecordProperty("greatest_kinetic_energy_J_kg", fmt::format("{:.2e}", greatest_energy));
}

/// First mode of a basin of length L and depth d: omega^2 = g k tanh(k d), k = pi / L.
TEST(MpsVerification, StandingWaveHasItsPeriod) {
  const double l0 = 0.02;
  const double length = 0.8;
  const double depth = 0.4;
  const double k = std::numbers::pi / length;
  const double period = 2 * std::numbers::pi / std::sqrt(9.81 * k * std::tanh(k * depth));
  const Scene scene = tank_with_block(l0, {length, 6 * l0, 0.8}, {length, 6 * l0, depth});
  MpsSolver<FloatPack> solver(scene, parameters_for(l0, 5), 2);
  const double speed = 0.25;
  for (std::size_t i = 0; i < scene.fluid.size(); ++i) {
    const Vec3d& r = scene.fluid[i];
    const double scale = speed / std::cosh(k * depth);
    solver.set_velocity(static_cast<std::int32_t>(i), {-scale * std::sin(k * r.x) * std::cosh(k * r.z), 0,
                                                       scale * std::cos(k * r.x) * std::sinh(k * r.z)});
  }
  std::vector<double> crossings;
  double before = 0;
  while (solver.time_s() < 3.3 * period) {
    solver.step();
    const auto& p = solver.particles();
    double mode = 0;
    for (std::size_t i = p.first_fluid(); i < p.size(); ++i) mode += p.position.z[i] * std::cos(k * p.position.x[i]);
    if (before * mode < 0)
      crossings.push_back(solver.time_s() - solver.parameters().time_step_s() * mode / (mode - before));
    before = mode;
  }
  ASSERT_GE(crossings.size(), 5U);
  const double found = 2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  RecordProperty("period_over_exact", fmt::format("{:.4f}", found / period));
  EXPECT_NEAR(found / period, 1, 0.03);
}

}  // namespace
}  // namespace sluice::mps
