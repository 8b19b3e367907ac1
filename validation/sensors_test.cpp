#include "validation/sensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "validation/case.h"

namespace sluice {
namespace {

constexpr double l0 = 0.02;
constexpr double h = 1.5 * l0;

// Wendland's C2 kernel of radius 2h in three dimensions.
double kernel(double r) {
  const double q = r / h;
  if (q >= 2) return 0;
  const double a = 1 - q / 2;
  return 21 / (16 * std::numbers::pi * h * h * h) * a * a * a * a * (2 * q + 1);
}

// A solver that only has particles: what sensors ask of it, it sums. Pressures are the caller's formulas.
class Particles : public Solver {
 public:
  std::vector<Vec3d> fluid;
  double kernel_support = 1;
  mutable std::vector<Vec3d> wall_points;
  mutable std::vector<Vec3d> kernel_points;
  mutable int fractions_asked = 0;

  // A slab of particles around the probe's line, wide enough to fill its kernel. Bottom layer's centres at z_low +
  // l0/2.
  void add_slab(double z_low, int layers, double half_width = 4 * l0) {
    const int n = static_cast<int>(std::ceil(half_width / l0));
    for (int k = 0; k < layers; ++k)
      for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j) fluid.push_back({(i + 0.3) * l0, (j - 0.1) * l0, z_low + (k + 0.5) * l0});
  }

  double volume_fraction(const Vec3d& p) const override {
    ++fractions_asked;
    double sum = 0;
    for (const Vec3d& f : fluid) sum += l0 * l0 * l0 * kernel(std::sqrt(dot(f - p, f - p)));
    return sum;
  }
  PressureReading kernel_pressure(const Vec3d& p) const override {
    kernel_points.push_back(p);
    return {300, kernel_support};
  }
  PressureReading wall_pressure(const Vec3d& p) const override {
    wall_points.push_back(p);
    return {500, 1};
  }
  VelocityReading kernel_velocity(const Vec3d&) const override { return {{2, 0, -1}, kernel_support}; }
  Vec3d wall_reaction_N(std::span<const std::int32_t> walls, const Box&) const override {
    return {static_cast<double>(walls.size()), 0, 0};
  }
  double wall_particle_pressure_Pa(std::int32_t) const override { return 700; }
  double smoothing_length_m() const override { return h; }

  double step() override { return 0; }
  double time_s() const override { return 0; }
  std::int64_t steps() const override { return 0; }
  std::int64_t fluid_count() const override { return 0; }
  std::int64_t solid_count() const override { return 0; }
  LostParticles lost() const override { return {}; }
  PhaseTimes phases() const override { return {}; }
  std::int64_t memory_bytes() const override { return 0; }
  std::map<std::string, double> facts() const override { return {}; }
  FluidTotals totals() const override { return {1, 2, 1.25}; }
  ParticleSnapshot snapshot() const override { return {}; }
  void visit_state(StateArchive&) override {}
};

ProbeLine line_from(double bed_z_m) {
  return {0, 0, bed_z_m, bed_z_m + 1.0, l0, h};
}

class StillLayer : public ::testing::TestWithParam<int> {};

TEST_P(StillLayer, ReadsItsHeight) {
  const int layers = GetParam();
  for (const double bed : {0.0, 0.16}) {
    Particles solver;
    solver.add_slab(bed, layers);
    const WaveHeights read = wave_heights(solver, line_from(bed));
    EXPECT_NEAR(read.column_m, layers * l0, 0.1 * l0) << "bed at " << bed;
    EXPECT_DOUBLE_EQ(read.top_m, read.column_m);
  }
}
INSTANTIATE_TEST_SUITE_P(Layers, StillLayer, ::testing::Values(1, 2, 3, 5, 20));

// Particles of a running flow are not on a lattice.
TEST_P(StillLayer, ReadsItsHeightInDisorder) {
  const int layers = GetParam();
  Particles solver;
  solver.add_slab(0, layers);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.2 * l0, 0.2 * l0);
  for (Vec3d& p : solver.fluid) p += {shift(random), shift(random), shift(random)};
  EXPECT_NEAR(wave_heights(solver, line_from(0)).column_m, layers * l0, 0.2 * l0);
}

// A surface that rises by less than the scan's step moves the reading by as much.
TEST(WaveHeight, FollowsASmallRise) {
  double last = -l0;
  for (const double rise : {0.0, 0.1 * l0, 0.2 * l0, 0.3 * l0, 0.4 * l0, 0.5 * l0, 0.6 * l0}) {
    Particles solver;
    solver.add_slab(-5 * l0 + rise, 15);  // the fluid passes through the bed: only its surface matters here
    const double read = wave_heights(solver, line_from(-3 * l0)).column_m - 13 * l0;
    EXPECT_NEAR(read, rise, 0.05 * l0);
    EXPECT_GT(read, last);
    last = read;
  }
}

TEST(WaveHeight, ADryBedReadsZero) {
  const Particles solver;
  const WaveHeights read = wave_heights(solver, line_from(0));
  EXPECT_EQ(read.column_m, 0);
  EXPECT_EQ(read.top_m, 0);
}

TEST(WaveHeight, ALoneParticleIsNoFluid) {
  Particles solver;
  solver.fluid.push_back({0, 0, 0.3});
  solver.fluid.push_back({0, 0, l0 / 2});
  const WaveHeights read = wave_heights(solver, line_from(0));
  EXPECT_EQ(read.column_m, 0);
  EXPECT_EQ(read.top_m, 0);
}

TEST(WaveHeight, ColumnEndsAtTheGapAndTopAtTheHighestFluid) {
  Particles solver;
  solver.add_slab(0, 5);
  solver.add_slab(20 * l0, 6);
  const WaveHeights read = wave_heights(solver, line_from(0));
  EXPECT_NEAR(read.column_m, 5 * l0, 0.1 * l0);
  EXPECT_NEAR(read.top_m, 26 * l0, 0.1 * l0);
}

TEST(WaveHeight, FluidInFlightIsNoColumn) {
  Particles solver;
  solver.add_slab(10 * l0, 5);
  const WaveHeights read = wave_heights(solver, line_from(0));
  EXPECT_EQ(read.column_m, 0);
  EXPECT_NEAR(read.top_m, 15 * l0, 0.1 * l0);
}

// Dynamic walls hold fluid off the bed by about h: it stands on the bed all the same.
TEST(WaveHeight, FluidHeldOffTheBedIsAColumn) {
  Particles solver;
  solver.add_slab(h, 8);
  EXPECT_NEAR(wave_heights(solver, line_from(0)).column_m, h + 8 * l0, 0.1 * l0);
}

TEST(WaveHeight, AFullTankReadsItsTop) {
  Particles solver;
  solver.add_slab(0, 60);
  EXPECT_DOUBLE_EQ(wave_heights(solver, line_from(0)).column_m, 1.0);
  EXPECT_DOUBLE_EQ(wave_heights(solver, line_from(0)).top_m, 1.0);
}

TEST(WaveHeight, EmptyAirCostsLittle) {
  const Particles empty;
  wave_heights(empty, line_from(0));
  EXPECT_LT(empty.fractions_asked, 60);  // 100 levels, all of which a plain scan would ask, mirrored ones twice
}

TEST(WaveHeight, TheMirrorFillsTheKernelAtTheBed) {
  Particles solver;
  solver.add_slab(0, 10);
  EXPECT_NEAR(solver.volume_fraction({0, 0, 0}), 0.5, 0.02);
  for (const double z : {0.0, 0.5 * l0, l0, 3 * l0, 5 * l0})
    EXPECT_NEAR(mirrored_fraction(solver, line_from(0), z), 1.0, 0.02) << z;
}

// A tank whose box moves when it is fitted to the lattice.
Scene moved_box() {
  Scene scene;
  scene.description.tank = {{0, 0, 0}, {3.22, 1, 1}};
  scene.description.obstacles = {{.box = {{0.6635, 0.2985, 0}, {0.8245, 0.7015, 0.161}}}};
  scene.description.particle_distance_m = l0;
  scene.fitted = scene.description;
  scene.fitted.tank.upper.x = 3.24;
  scene.fitted.obstacles = {{.box = {{0.66, 0.3, 0}, {0.82, 0.7, 0.16}}}};
  return scene;
}

TEST(Placement, FollowsTheFittedFace) {
  const Scene scene = moved_box();
  EXPECT_EQ(on_fitted_face(scene, {0.8245, 0.4745, 0.021}, {1, 0, 0}), (Vec3d{0.82, 0.4745, 0.021}));
  EXPECT_EQ(on_fitted_face(scene, {0.8035, 0.5255, 0.161}, {0, 0, 1}), (Vec3d{0.8035, 0.5255, 0.16}));
  EXPECT_EQ(on_fitted_face(scene, {3.22, 0.5, 0.1}, {-1, 0, 0}), (Vec3d{3.24, 0.5, 0.1}));
  EXPECT_EQ(on_fitted_face(scene, {1.0, 0.5, 0}, {0, 0, 1}), (Vec3d{1.0, 0.5, 0}));
  const Vec3d nowhere{1.7, 0.5, 0.3};
  EXPECT_EQ(on_fitted_face(scene, nowhere, {1, 0, 0}), nowhere);
}

Case small_case() {
  Case c;
  c.sensors = {{"H1", SensorKind::wave_height, {0, 0, 0}, {0, 0, 1}, ""},
               {"P1", SensorKind::pressure, {0.8245, 0.4745, 0.021}, {1, 0, 0}, ""}};
  c.solvers = {{"wcsph", "extrapolated", {{"extrapolated", 3, "wall", "column"}, {"dynamic", 1, "kernel", "top"}}, {}}};
  return c;
}

double value_of(const SensorArray& array, const Solver& solver, const std::string& name) {
  const std::vector<std::string> names = array.columns();
  std::vector<double> values{99};
  array.sample(solver, values);
  EXPECT_EQ(values.size(), names.size());
  const auto at = std::find(names.begin(), names.end(), name);
  EXPECT_NE(at, names.end()) << name;
  return values.at(static_cast<std::size_t>(at - names.begin()));
}

TEST(SensorArray, NamesTheColumnsOfTheRunDirectory) {
  const SensorArray array(small_case(), moved_box(), h, "wcsph", "extrapolated");
  EXPECT_EQ(array.columns(), (std::vector<std::string>{"H1_m", "H1_column_m", "H1_top_m", "P1_Pa", "P1_wall_Pa",
                                                       "P1_kernel_Pa", "P1_kernel_support_1", "kinetic_energy_J",
                                                       "potential_energy_J", "greatest_density_ratio_1"}));
}

TEST(SensorArray, ThePlainColumnIsThePrimaryModelOfTheWalls) {
  Particles solver;
  solver.add_slab(0, 5);
  solver.add_slab(20 * l0, 6);
  const SensorArray own(small_case(), moved_box(), h, "wcsph", "extrapolated");
  EXPECT_EQ(value_of(own, solver, "P1_Pa"), 500);
  EXPECT_NEAR(value_of(own, solver, "H1_m"), 5 * l0, 0.1 * l0);
  const SensorArray paper(small_case(), moved_box(), h, "wcsph", "dynamic");
  EXPECT_EQ(value_of(paper, solver, "P1_Pa"), 300);
  EXPECT_NEAR(value_of(paper, solver, "H1_m"), 26 * l0, 0.1 * l0);
  EXPECT_EQ(value_of(paper, solver, "P1_wall_Pa"), 500);
  EXPECT_EQ(value_of(own, solver, "P1_kernel_Pa"), 300);
}

TEST(SensorArray, ReadsTheKernelOneSmoothingLengthOffTheFittedFace) {
  const Particles solver;
  const SensorArray array(small_case(), moved_box(), h, "wcsph", "extrapolated");
  value_of(array, solver, "P1_Pa");
  ASSERT_EQ(solver.kernel_points.size(), 1U);
  EXPECT_DOUBLE_EQ(solver.kernel_points[0].x, 0.82 + h);
  EXPECT_DOUBLE_EQ(solver.wall_points.at(0).x, 0.82);
  const PlacedSensor placed = array.placed().at(1);
  EXPECT_EQ(placed.primary, "wall");
  EXPECT_DOUBLE_EQ(placed.placed_m.x, 0.82);
  EXPECT_DOUBLE_EQ(placed.position_m.x, 0.8245);
  EXPECT_DOUBLE_EQ(placed.offset_m, h);
}

TEST(SensorArray, TooLittleFluidReadsNoKernelPressure) {
  Particles solver;
  const SensorArray array(small_case(), moved_box(), h, "wcsph", "dynamic");
  solver.kernel_support = 0.04;
  EXPECT_EQ(value_of(array, solver, "P1_kernel_Pa"), 0);
  EXPECT_EQ(value_of(array, solver, "P1_kernel_support_1"), 0.04);
  solver.kernel_support = 0.06;
  EXPECT_EQ(value_of(array, solver, "P1_kernel_Pa"), 300);
}

// The constant's reason, as sensors.h states it.
TEST(SensorArray, TheKernelThresholdIsOneParticleOneDistanceOff) {
  EXPECT_NEAR(l0 * l0 * l0 * kernel(l0), minimum_kernel_support, 0.01);
}

TEST(SensorArray, AProbeOverTheBoxStandsOnIt) {
  Case c = small_case();
  c.sensors[0].position_m = {0.75, 0.5, 0};
  const SensorArray array(c, moved_box(), h, "wcsph", "extrapolated");
  EXPECT_DOUBLE_EQ(array.placed().at(0).placed_m.z, 0.16);
}

TEST(SensorArray, TotalsOfTheFluidStandBehindTheSensors) {
  const Particles solver;
  const SensorArray array(small_case(), moved_box(), h, "wcsph", "extrapolated");
  EXPECT_EQ(value_of(array, solver, "kinetic_energy_J"), 1);
  EXPECT_EQ(value_of(array, solver, "potential_energy_J"), 2);
  EXPECT_EQ(value_of(array, solver, "greatest_density_ratio_1"), 1.25);
}

TEST(SensorArray, NamesASensorWhoseModelIsUnknown) {
  Case c = small_case();
  for (const char* model : {"mean", "nearest"}) {
    c.solvers[0].walls[0].pressure_model = model;
    try {
      const SensorArray array(c, moved_box(), h, "wcsph", "extrapolated");
      FAIL() << "an unknown model was accepted";
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("P1"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(model), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace sluice
