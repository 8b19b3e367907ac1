// Kernel, equation of state and pair terms, each in scalar double precision and in single-precision packs.
#include "solvers/wcsph/terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solvers/wcsph/equation_of_state.h"
#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/time_step.h"
#include "solvers/wcsph/verlet.h"

namespace sluice::wcsph {
namespace {

constexpr double h = 0.03;

/// The same tests for the reference's number and for the fast path's.
template <class Pack>
class Terms : public testing::Test {
 protected:
  using Real = typename Lanes<Pack>::Real;
  static Pack pack(double value) { return Pack(static_cast<Real>(value)); }
  static double lane(const Pack& p) { return static_cast<double>(lane_max(p)); }
  static double weight(double r) {
    return lane(wendland_weight(wendland_taper(pack(r), pack(0.5 / h)), pack(Wendland{h}.normalisation())));
  }
  /// dW/dr from the gradient's shape: grad_i W = G0 g r_ij points from i to j, so dW/dr_ij = -G0 g r.
  static double slope(double r) {
    return -wendland_gradient_constant({h}) * lane(wendland_gradient_shape(wendland_taper(pack(r), pack(0.5 / h)))) * r;
  }
  static constexpr double tolerance = sizeof(Real) == 8 ? 1e-10 : 2e-5;
};
using Paths = testing::Types<double, FloatPack>;
TYPED_TEST_SUITE(Terms, Paths);

TYPED_TEST(Terms, TheKernelsIntegralIsOne) {
  double integral = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double r = 2 * h * (k + 0.5) / n;
    integral += this->weight(r) * 4 * std::numbers::pi * r * r * (2 * h / n);
  }
  EXPECT_NEAR(integral, 1.0, std::max(1e-8, this->tolerance));
}

TYPED_TEST(Terms, TheKernelsSecondMomentIsThatOfTheWendlandKernel) {
  // int W r^2 dV = 4 pi varpi h^5 int_0^2 q^4 (1 - q/2)^4 (2q + 1) dq = h^2 (21/4) (8/35 - 32/154 + ...): by Simpson
  // below in q.
  const auto integrand = [](double q) { return std::pow(q, 4) * std::pow(1 - q / 2, 4) * (2 * q + 1); };
  double simpson = 0;
  const int n = 2000;
  for (int k = 0; k < n; ++k) {
    const double a = 2.0 * k / n;
    const double b = 2.0 * (k + 1) / n;
    simpson += (b - a) / 6 * (integrand(a) + 4 * integrand((a + b) / 2) + integrand(b));
  }
  double moment = 0;
  for (int k = 0; k < 20000; ++k) {
    const double r = 2 * h * (k + 0.5) / 20000;
    moment += this->weight(r) * r * r * 4 * std::numbers::pi * r * r * (2 * h / 20000);
  }
  EXPECT_NEAR(moment / (h * h), 21.0 / 4.0 * simpson, 1e-4);
}

TYPED_TEST(Terms, TheGradientIsTheKernelsSlope) {
  for (const double q : {0.1, 0.5, 1.0, 1.5, 1.9}) {
    const double r = q * h;
    const double analytic = Wendland{h}.normalisation() / h * (-5 * q * std::pow(1 - q / 2, 3));
    EXPECT_NEAR(this->slope(r) / analytic, 1.0, 100 * this->tolerance) << "q = " << q;
  }
}

TYPED_TEST(Terms, NothingBeyondTheRadius) {
  for (const double r : {2.0 * h, 2.1 * h, 100 * h}) {
    EXPECT_NEAR(this->weight(r), 0, 1e-12 / (h * h * h));
    EXPECT_NEAR(this->slope(r), 0, 1e-9);
  }
}

TYPED_TEST(Terms, APairThatApproachesGainsDensityAndOneThatPartsLosesIt) {
  using T = Terms<TypeParam>;
  EXPECT_GT(T::lane(continuity_term(T::pack(0.3), T::pack(-1.0))), 0);
  EXPECT_LT(T::lane(continuity_term(T::pack(0.3), T::pack(1.0))), 0);
}

TYPED_TEST(Terms, DensityDiffusesFromTheDenserToTheThinner) {
  using T = Terms<TypeParam>;
  EXPECT_GT(T::lane(diffusion_term(T::pack(0), T::pack(5), T::pack(1e-6), T::pack(0.3))), 0);
  EXPECT_LT(T::lane(diffusion_term(T::pack(5), T::pack(0), T::pack(1e-6), T::pack(0.3))), 0);
}

TYPED_TEST(Terms, ViscosityRepelsPairsThatApproachOnly) {
  using T = Terms<TypeParam>;
  const auto closing = artificial_viscosity(T::pack(-0.01), T::pack(4e-4), T::pack(9e-6), T::pack(2000), T::pack(80));
  const auto parting = artificial_viscosity(T::pack(0.01), T::pack(4e-4), T::pack(9e-6), T::pack(2000), T::pack(80));
  // mu/h = u.r / (r^2 + eta^2); Pi/(alpha h) = -(c/rho) mu/h
  EXPECT_NEAR(T::lane(closing.mu), -0.01 / 4.09e-4, 1e-3);
  EXPECT_NEAR(T::lane(closing.Pi), 80.0 / 2000.0 * 0.01 / 4.09e-4, 1e-4);
  EXPECT_NEAR(T::lane(parting.mu), 0.01 / 4.09e-4, 1e-3);
  EXPECT_EQ(T::lane(parting.Pi), 0);
}

TYPED_TEST(Terms, PressureAndViscosityOfAPairAddUpInTheMomentumTerm) {
  using T = Terms<TypeParam>;
  const double mass = 8e-3;
  const double expected = ((3000.0 + 1000.0) / (1001.0 * 999.0) + 0.02) * mass * 0.25;
  const double term = T::lane(momentum_term(T::pack(3000), T::pack(1000), T::pack(1 / 1001.0), T::pack(mass / 999.0),
                                            T::pack(mass * 0.02), T::pack(0.25)));
  EXPECT_NEAR(term / expected, 1.0, this->tolerance);
}

TYPED_TEST(Terms, APairBearsNoLessPressureThanItsLeast) {
  using T = Terms<TypeParam>;
  const auto borne = [](double P_i, double P_j) {
    return P_i + T::lane(borne_pressure(T::pack(P_i), T::pack(P_j), T::pack(-500)));
  };
  EXPECT_EQ(borne(3000, -1000), 2000);
  EXPECT_EQ(borne(-100, -200), -300);
  EXPECT_EQ(borne(-3000, 1000), -500);
  EXPECT_EQ(borne(-3000, -3000), -500);
}

TYPED_TEST(Terms, AWallBelowTheFluidCarriesTheWeightBetween) {
  using T = Terms<TypeParam>;
  const Vec3<TypeParam> gravity{T::pack(0), T::pack(0), T::pack(-9.81)};
  const Vec3<TypeParam> down{T::pack(0.01), T::pack(0), T::pack(-0.02)};
  EXPECT_NEAR(T::lane(extrapolated_pressure(T::pack(500), T::pack(1000), gravity, down)), 500 + 1000 * 9.81 * 0.02,
              1e-2);
}

TEST(EquationOfState, TurnsRoundAndMatchesThePrintedForm) {
  const Tait tait{1000, 46.4};
  for (const double deviation : {-5.0, 0.0, 1e-3, 3.0, 40.0}) {
    const double P = tait_pressure(deviation, tait);
    const double printed = tait.stiffness_Pa() * (std::pow((1000 + deviation) / 1000, 7) - 1);
    EXPECT_NEAR(P, printed, 1e-6 * std::abs(printed) + 1e-6);
    EXPECT_NEAR(tait_density_deviation(P, tait), deviation, 1e-9);
  }
}

TYPED_TEST(Terms, DensityOfAPressureTurnsTheEquationOfStateRound) {
  const Tait tait{1000, 46.4};
  for (const double pressure_over_B : {-0.5, 0.0, 1e-6, 1e-3, 0.1, 1.0, 4.0, 16.0}) {
    const double exact = 1000 * std::expm1(std::log1p(pressure_over_B) / 7);
    const double found = this->lane(tait_density_deviation(this->pack(pressure_over_B * tait.stiffness_Pa()), tait));
    EXPECT_NEAR(found, exact, this->tolerance * std::abs(exact)) << pressure_over_B << " B";
  }
}

TEST(EquationOfState, SpeedOfSoundIsTheSlope) {
  const Tait tait{1000, 46.4};
  EXPECT_NEAR(tait_speed_of_sound(0.0, tait), 46.4, 1e-12);
  const double slope = (tait_pressure(10.001, tait) - tait_pressure(9.999, tait)) / 0.002;
  EXPECT_NEAR(tait_speed_of_sound(10.0, tait), std::sqrt(slope), 1e-6);
}

TEST(TimeStep, TakesTheStricterCondition) {
  Parameters p;
  p.particle_distance_m = 0.02;
  p.speed_of_sound_m_s = 46.4;
  EXPECT_NEAR(time_step(p, {9.81, 0}), 0.2 * 0.03 / 46.4, 1e-12);
  EXPECT_NEAR(time_step(p, {9.81, 3.6}), 0.2 * 0.03 / 50.0, 1e-12);
  EXPECT_NEAR(time_step(p, {1e6, 0}), 0.2 * std::sqrt(0.03 / 1e6), 1e-12);
  EXPECT_GT(time_step(p, {0, 0}), 0);
}

TEST(TimeStep, OneThatHasCollapsedEndsTheRun) {
  Parameters p;
  p.particle_distance_m = 0.02;
  p.speed_of_sound_m_s = 46.4;
  EXPECT_NO_THROW(require_progress(p, time_step(p, {1e8, 0}), 0.5));
  EXPECT_THROW(require_progress(p, time_step(p, {1e12, 0}), 0.5), std::runtime_error);
  EXPECT_THROW(require_progress(p, std::nan(""), 0.5), std::runtime_error);
}

TEST(Verlet, LeapsOverTwoStepsAndRestartsOverOne) {
  EXPECT_DOUBLE_EQ(verlet_value(2.0, 1.5, 10.0, 0.1, VerletForm::leap), 1.5 + 0.2 * 10.0);
  EXPECT_DOUBLE_EQ(verlet_value(2.0, 1.5, 10.0, 0.1, VerletForm::restart), 2.0 + 0.1 * 10.0);
  EXPECT_DOUBLE_EQ(verlet_displacement(2.0, 10.0, 0.1), 0.2 + 0.05);
}

}  // namespace
}  // namespace sluice::wcsph
