#include "solvers/mps/mps_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solvers/memory_archive.h"
#include "solvers/mps/direct_solver.h"
#include "solvers/mps/test_tank.h"

namespace sluice::mps {
namespace {

/// A small dam break: fluid in a third of the tank.
Scene small_dam() {
  return tank_with_block(0.04, {0.8, 0.24, 0.6}, {0.28, 0.24, 0.32});
}

template <class Pack>
void run(MpsSolver<Pack>& solver, int steps) {
  for (int k = 0; k < steps; ++k) solver.step();
}

TEST(MpsSolver, SameBitsOnAnyNumberOfThreads) {
  MpsSolver<FloatPack> one(small_dam(), parameters_for(0.04, 5), 1);
  run(one, 60);
  for (const int threads : {2, 4}) {
    MpsSolver<FloatPack> many(small_dam(), parameters_for(0.04, 5), threads);
    run(many, 60);
    EXPECT_EQ(one.particles().position.x, many.particles().position.x) << threads;
    EXPECT_EQ(one.particles().velocity.z, many.particles().velocity.z) << threads;
    EXPECT_EQ(one.particles().pressure, many.particles().pressure) << threads;
  }
}

/// At every step for a while, since some steps list neighbours twice and most do not.
TEST(MpsSolver, GoesOnFromASavedStateBitForBit) {
  MpsSolver<FloatPack> straight(small_dam(), parameters_for(0.04, 5), 2);
  run(straight, 75);
  for (int saved_after = 60; saved_after < 70; ++saved_after) {
    MpsSolver<FloatPack> first(small_dam(), parameters_for(0.04, 5), 2);
    run(first, saved_after);
    MemoryArchive archive;
    first.visit_state(archive);
    archive.rewind();
    MpsSolver<FloatPack> second(small_dam(), parameters_for(0.04, 5), 1);
    second.visit_state(archive);
    EXPECT_EQ(second.wall_pressure({0, 0.12, 0.02}).pressure_Pa, first.wall_pressure({0, 0.12, 0.02}).pressure_Pa);
    EXPECT_EQ(second.volume_fraction({0.2, 0.12, 0.1}), first.volume_fraction({0.2, 0.12, 0.1}));
    EXPECT_EQ(second.totals().greatest_density_ratio, first.totals().greatest_density_ratio);
    run(second, 75 - saved_after);
    ASSERT_EQ(straight.particles().position.x, second.particles().position.x) << saved_after;
    EXPECT_EQ(straight.particles().velocity.z, second.particles().velocity.z) << saved_after;
    EXPECT_EQ(straight.particles().pressure, second.particles().pressure) << saved_after;
    EXPECT_EQ(straight.facts(), second.facts()) << saved_after;
  }
}

/// CHOLMOD on the whole matrix is the known answer.
TEST(MpsSolver, PressuresAreThoseOfADirectSolution) {
  Parameters p = parameters_for(0.04, 5);
  for (const Preconditioner preconditioner : {Preconditioner::multigrid, Preconditioner::jacobi}) {
    p.preconditioner = preconditioner;
    MpsSolver<double> solver(small_dam(), p, 2);
    run(solver, 40);
    const auto& equation = solver.pressure_equation();
    DirectSolver direct;
    direct.factorise(equation.matrix());
    std::vector<double> x(equation.right_side().size());
    direct.solve(std::span<const double>(equation.right_side()), std::span<double>(x));
    double greatest = 0;
    double difference = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      greatest = std::max(greatest, std::abs(x[i]));
      difference = std::max(difference, std::abs(std::max(0.0, x[i]) - solver.particles().pressure[i]));
    }
    EXPECT_GT(greatest, 500);
    EXPECT_LT(difference, 1e-5 * greatest);
  }
}

TEST(MpsSolver, FastPathFollowsTheReference) {
  MpsSolver<double> reference(small_dam(), parameters_for(0.04, 5), 1);
  MpsSolver<FloatPack> fast(small_dam(), parameters_for(0.04, 5), 1);
  run(reference, 20);
  run(fast, 20);
  ASSERT_EQ(reference.particles().id, fast.particles().id);
  for (std::size_t i = 0; i < fast.particles().size(); ++i) {
    const Vec3d d = reference.particles().position.at<double>(i) - fast.particles().position.at<double>(i);
    EXPECT_LT(std::sqrt(dot(d, d)), 1e-3 * 0.04);
  }
}

TEST(MpsSolver, MultigridNeedsFewIterations) {
  MpsSolver<FloatPack> solver(small_dam(), parameters_for(0.04, 5), 2);
  run(solver, 50);
  EXPECT_LE(solver.facts().at("iterations_max"), 20);
}

/// Large enough for levels of levels, whose cycle is a recursion.
TEST(MpsSolver, MultigridOfManyLevelsNeedsFewIterationsAndIsTheSameOnAnyNumberOfThreads) {
  const Scene scene = tank_with_block(0.02, {0.8, 0.4, 0.4}, {0.4, 0.4, 0.3});
  MpsSolver<FloatPack> one(scene, parameters_for(0.02, 5), 1);
  MpsSolver<FloatPack> two(scene, parameters_for(0.02, 5), 2);
  run(one, 20);
  run(two, 20);
  EXPECT_GE(one.facts().at("multigrid_levels"), 3);
  EXPECT_LE(one.facts().at("iterations_max"), 20);
  EXPECT_EQ(one.particles().pressure, two.particles().pressure);
}

TEST(DirectSolver, RefusesAMatrixThatIsNotPositiveDefinite) {
  const std::vector<Span> rows{{0, 1}, {2, 3}};
  const std::vector<std::int32_t> columns{1, 0, 0, 0};
  const std::vector<double> weights{2, 0, 2, 0};
  const std::vector<double> diagonal{1, 1};  // with 2 beside it: eigenvalues 3 and -1
  const std::vector<std::uint8_t> has_row{1, 1};
  PressureMatrix<double> A;
  A.near = {rows, columns.data(), weights.data()};
  A.diagonal = diagonal;
  A.has_row = has_row;
  A.end = 2;
  DirectSolver solver;
  EXPECT_THROW(solver.factorise(A), std::runtime_error);
}

TEST(MpsSolver, ReportsASystemThatDoesNotConverge) {
  Parameters p = parameters_for(0.04, 5);
  p.preconditioner = Preconditioner::jacobi;
  p.most_iterations = 2;
  MpsSolver<FloatPack> solver(small_dam(), p, 1);
  try {
    solver.step();
    FAIL() << "converged in two iterations";
  } catch (const NotConverged& error) {
    EXPECT_NE(std::string(error.what()).find("did not converge"), std::string::npos);
    EXPECT_GT(solver.pressure_equation().history().size(), 2U);
  }
}

TEST(MpsSolver, AFreeParticleFalls) {
  Parameters p = parameters_for(0.02, 5);
  MpsSolver<FloatPack> solver(free_particles(0.02, {{0.4, 0.4, 0.4}}), p, 1);
  run(solver, 50);
  const double t = solver.time_s();
  const std::size_t i = solver.particles().first_fluid();
  EXPECT_NEAR(solver.particles().velocity.z[i], -9.81 * t, 1e-5);
  EXPECT_NEAR(solver.particles().position.z[i], 0.4 - 0.5 * 9.81 * t * (t + p.time_step_s()), 1e-5);
}

/// Two particles that meet; `accuracy` is of their momentum.
template <class Pack>
void expect_a_collision(double accuracy) {
  Parameters p = parameters_for(0.02, 5);
  p.gravity_m_s2 = {0, 0, 0};
  MpsSolver<Pack> solver(free_particles(0.02, {{0.39, 0.4, 0.4}, {0.412, 0.4, 0.4}}), p, 1);
  solver.set_velocity(0, {3, 0, 0});
  solver.set_velocity(1, {-2, 0, 0});
  run(solver, 4);
  const auto& u = solver.particles().velocity;
  const std::size_t i = solver.particles().first_fluid();
  EXPECT_NEAR(u.x[i] + u.x[i + 1], 1, accuracy);
  EXPECT_NEAR(std::abs(u.x[i] - u.x[i + 1]), 0.2 * 5, 1e-4);  // restitution; viscosity takes a trace
}

TEST(MpsSolver, CollisionsKeepMomentumAndTakeEnergy) {
  expect_a_collision<double>(1e-9);
  expect_a_collision<FloatPack>(1e-6);
}

/// What is listed so that lists outlive a small displacement is no neighbour.
TEST(MpsSolver, NeighboursEndAtTheEffectiveRadius) {
  const double l0 = 0.02;
  for (const double apart : {2.09, 2.11}) {
    MpsSolver<FloatPack> solver(free_particles(l0, {{0.4, 0.4, 0.4}, {0.4 + apart * l0, 0.4, 0.4}}),
                                parameters_for(l0, 5), 1);
    EXPECT_EQ(solver.neighbours().count(solver.particles().first_fluid()), apart < 2.1 ? 1U : 0U) << apart;
  }
}

/// A particle that slides along the floor while it falls on it loses what goes into the floor and keeps the rest: the
/// lattice of wall particles is not felt.
TEST(MpsSolver, WallsStopWhatGoesIntoThemOnly) {
  const double l0 = 0.02;
  Parameters p = parameters_for(l0, 5);
  p.gravity_m_s2 = {0, 0, 0};
  p.viscosity_m2_s = 0;
  for (const double height : {0.05, 0.3}) {
    MpsSolver<double> solver(free_particles(l0, {{0.393, 0.402, height * l0}}), p, 1);
    solver.set_velocity(0, {2, 1, -3});
    run(solver, 20);
    const Vec3d u = solver.particles().velocity.at<double>(solver.particles().first_fluid());
    EXPECT_NEAR(u.x, 2, 1e-9);
    EXPECT_NEAR(u.y, 1, 1e-9);
    EXPECT_NEAR(u.z, 0, 1e-9);
  }
}

TEST(MpsSolver, WallsWithoutContactStopNothing) {
  const double l0 = 0.02;
  Parameters p = parameters_for(l0, 5);
  p.gravity_m_s2 = {0, 0, 0};
  p.viscosity_m2_s = 0;
  p.wall_contact_over_distance = 0;
  MpsSolver<double> solver(free_particles(l0, {{0.393, 0.402, 0.05 * l0}}), p, 1);
  solver.set_velocity(0, {0, 0, -3});
  run(solver, 8);
  EXPECT_LT(solver.particles().velocity.z[solver.particles().first_fluid()], -2.9) << "past the layer's plane";
}

/// The gradient with the least pressure as reference does not act in equal and opposite pairs: momentum of a drop is
/// kept only nearly.
TEST(MpsSolver, MomentumOfADropIsNearlyKept) {
  const double l0 = 0.02;
  Parameters p = parameters_for(l0, 5);
  p.gravity_m_s2 = {0, 0, 0};
  MpsSolver<FloatPack> solver(free_particles(l0, jittered_cube(l0, 8, 0.1)), p, 1);
  for (std::int32_t k = 0; k < 512; ++k) solver.set_velocity(k, {0.5, k % 2 == 0 ? 0.1 : -0.1, 0});
  run(solver, 200);
  Vec3d sum;
  for (std::size_t i = solver.particles().first_fluid(); i < solver.particles().size(); ++i)
    sum += solver.particles().velocity.at<double>(i);
  EXPECT_NEAR(sum.x / 512, 0.5, 0.01);
  EXPECT_NEAR(sum.y / 512, 0, 0.01);
  EXPECT_NEAR(sum.z / 512, 0, 0.01);
}

TEST(MpsSolver, RefusesParametersOutOfRange) {
  Parameters p = parameters_for(0.04, 5);
  p.kappa_r = 0;
  EXPECT_THROW(MpsSolver<FloatPack>(small_dam(), p, 1), std::invalid_argument);
  p = parameters_for(0.04, 5);
  p.courant = 2;
  EXPECT_THROW(MpsSolver<FloatPack>(small_dam(), p, 1), std::invalid_argument);
}

TEST(MpsSolver, StaysWithinItsMemory) {
  MpsSolver<FloatPack> solver(tank_with_block(0.02, {0.8, 0.4, 0.4}, {0.4, 0.4, 0.3}), parameters_for(0.02, 5), 2);
  run(solver, 2);
  EXPECT_LT(static_cast<double>(solver.memory_bytes()) / static_cast<double>(solver.particles().size()), 700);
}

}  // namespace
}  // namespace sluice::mps
