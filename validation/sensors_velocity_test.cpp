// Velocity probes on both solvers: a block of fluid in mid-air that was given its velocities, so that readings are
// known.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solvers/mps/mps_solver.h"
#include "solvers/mps/test_tank.h"
#include "solvers/wcsph/test_tank.h"
#include "solvers/wcsph/wcsph_solver.h"
#include "validation/case.h"
#include "validation/sensors.h"

namespace sluice {
namespace {

constexpr double l0 = 0.02;
constexpr double middle_m = 20 * l0;                      // of the block along each axis
constexpr double face_m = middle_m + 4 * l0;              // its faces lie half a particle distance off the last centres
constexpr Vec3d inside{20.3 * l0, 19.6 * l0, 20.1 * l0};  // on no lattice plane

using Velocities = std::function<Vec3d(const Vec3d& position_m)>;

/// Eight particles along each edge: wider than the kernels of both solvers.
std::unique_ptr<Solver> block(const std::string& solver, const Velocities& velocity_m_s) {
  const std::vector<Vec3d> positions = mps::jittered_cube(l0, 8, 0);
  const auto count = static_cast<std::int32_t>(positions.size());
  const auto velocity_of = [&](std::int32_t id) { return velocity_m_s(positions[static_cast<std::size_t>(id)]); };
  if (solver == "mps") {
    auto s =
        std::make_unique<mps::MpsSolver<FloatPack>>(mps::free_particles(l0, positions), mps::parameters_for(l0, 5), 1);
    for (std::int32_t id = 0; id < count; ++id) s->set_velocity(id, velocity_of(id));
    return s;
  }
  auto s = std::make_unique<wcsph::WcsphSolver<FloatPack>>(wcsph::free_particles(l0, positions),
                                                           wcsph::free_parameters(l0), 1);
  for (std::int32_t id = 0; id < count; ++id) s->set_fluid(id, velocity_of(id), 0);
  return s;
}

constexpr Vec3d uniform_m_s{1.5, -0.25, 0.5};

std::unique_ptr<Solver> uniform_block(const std::string& solver) {
  return block(solver, [](const Vec3d&) { return uniform_m_s; });
}

/// What a probe's three columns hold.
struct Reading {
  double primary_m_s = 0;
  double kernel_m_s = 0;
  double support = 0;
};

Reading read(const Solver& solver, const Vec3d& position_m, const Vec3d& direction) {
  const CaseSensor sensor{"U", SensorKind::velocity, position_m, direction, ""};
  std::vector<double> values;
  make_velocity_probe(sensor, "kernel")->append_values(solver, values);
  EXPECT_EQ(values.size(), 3U);
  return {values.at(0), values.at(1), values.at(2)};
}

class VelocityProbes : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, VelocityProbes, ::testing::Values("wcsph", "mps"));

TEST_P(VelocityProbes, ReadTheComponentAlongTheirDirection) {
  const auto solver = uniform_block(GetParam());
  const VelocityReading mean = solver->kernel_velocity(inside);
  EXPECT_NEAR(mean.velocity_m_s.x, uniform_m_s.x, 1e-9);
  EXPECT_NEAR(mean.velocity_m_s.y, uniform_m_s.y, 1e-9);
  EXPECT_NEAR(mean.velocity_m_s.z, uniform_m_s.z, 1e-9);
  for (const Vec3d& direction : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{0.6, 0, 0.8}}) {
    const Reading u = read(*solver, inside, direction);
    EXPECT_NEAR(u.primary_m_s, dot(uniform_m_s, direction), 1e-9);
    EXPECT_EQ(u.kernel_m_s, u.primary_m_s);
    EXPECT_NEAR(u.support, 1, 0.01);
  }
}

// The mean is one over the fluid that there is: half a kernel of it has the whole velocity.
TEST_P(VelocityProbes, ReadTheWholeVelocityAtASurface) {
  const Reading u = read(*uniform_block(GetParam()), {face_m, middle_m, middle_m}, {1, 0, 0});
  EXPECT_NEAR(u.primary_m_s, uniform_m_s.x, 1e-9);
  EXPECT_NEAR(u.support, 0.5, 0.02);
}

TEST_P(VelocityProbes, ReadZeroWhereItIsDryOrOutside) {
  const auto solver = uniform_block(GetParam());
  for (const double x_m : {10 * l0, 30 * l0, -1.0, 2.0}) {
    const Reading u = read(*solver, {x_m, middle_m, middle_m}, {1, 0, 0});
    EXPECT_EQ(u.primary_m_s, 0) << x_m;
    EXPECT_EQ(u.kernel_m_s, 0) << x_m;
    EXPECT_EQ(u.support, 0) << x_m;
  }
}

// Where the kernel's rim only reaches the fluid, there is a mean, but too little of it to count.
TEST_P(VelocityProbes, ReadZeroWhereTooLittleFluidIsNear) {
  const auto solver = uniform_block(GetParam());
  const Vec3d off{face_m + 0.9 * solver->smoothing_length_m(), middle_m, middle_m};
  EXPECT_NEAR(solver->kernel_velocity(off).velocity_m_s.x, uniform_m_s.x, 1e-9);
  const Reading u = read(*solver, off, {1, 0, 0});
  EXPECT_EQ(u.primary_m_s, 0);
  EXPECT_EQ(u.kernel_m_s, 0);
  EXPECT_GT(u.support, 0);
  EXPECT_LT(u.support, minimum_kernel_support);
}

// By symmetry half-way between two streams; beside their border the nearer one counts more.
TEST_P(VelocityProbes, ReadTheKernelsMeanOfTwoStreams) {
  const auto solver = block(GetParam(), [](const Vec3d& r) { return Vec3d{r.x < middle_m ? 1.0 : 3.0, 0, 0}; });
  const auto at = [&](double x_m) { return read(*solver, {x_m, inside.y, inside.z}, {1, 0, 0}).primary_m_s; };
  EXPECT_NEAR(at(middle_m), 2, 1e-6);
  EXPECT_GT(at(middle_m + 0.3 * l0), 2.1);
  EXPECT_LT(at(middle_m + 0.3 * l0), 3);
  EXPECT_LT(at(middle_m - 0.3 * l0), 1.9);
  EXPECT_NEAR(at(middle_m + 3 * l0), 3, 1e-9) << "the other stream is out of the kernel's reach";
}

TEST(VelocityProbe, NamesItsColumns) {
  std::vector<std::string> names;
  make_velocity_probe({"U", SensorKind::velocity, inside, {1, 0, 0}, ""}, "kernel")->append_columns(names);
  EXPECT_EQ(names, (std::vector<std::string>{"U_m_s", "U_kernel_m_s", "U_kernel_support_1"}));
}

}  // namespace
}  // namespace sluice
