// The pair sums against a loop over all particles and the equations as the paper has them: no pair is missed or met
// twice, between two sorts too.
#include "solvers/wcsph/pair_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solvers/wcsph/neighbour_packs.h"
#include "solvers/wcsph/test_tank.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice::wcsph {
namespace {

template <class Pack>
class PairSums : public testing::Test {};
using Paths = testing::Types<double, FloatPack>;
TYPED_TEST_SUITE(PairSums, Paths);

struct Rates {
  Vec3d acceleration;
  double density_rate = 0;
};

/// Eq. (3), (4), (5) and (7), term by term, of one particle.
template <class Pack>
class Plain {
 public:
  Plain(const WcsphSolver<Pack>& solver, const Parameters& p) : s_(solver), p_(p), h_(p.smoothing_length_m()) {}

  Rates of(std::size_t i) const {
    Rates rates{p_.gravity_m_s2, 0};
    for (std::size_t j = 0; j < s_.fluid().n; ++j)
      if (j != i) add(rates, i, s_.fluid(), j, false);
    for (std::size_t j = 0; j < s_.walls().n; ++j) add(rates, i, s_.walls(), j, true);
    return rates;
  }

 private:
  void add(Rates& rates, std::size_t i, const Particles<Pack>& others, std::size_t j, bool wall) const {
    const Particles<Pack>& f = s_.fluid();
    const Vec3d r = others.position.template at<double>(j) - f.position.template at<double>(i);
    const double distance = std::sqrt(dot(r, r));
    const double q = distance / h_;
    if (q >= 2) return;
    const double varpi = 21 / (16 * std::numbers::pi * h_ * h_ * h_);
    const Vec3d gradient = 5 * varpi * std::pow(1 - q / 2, 3) / (h_ * h_) * r;
    const double m = p_.reference_density_kg_m3 * std::pow(p_.particle_distance_m, 3);
    const double density_i = p_.reference_density_kg_m3 + static_cast<double>(f.density[i]);
    const double density_j = p_.reference_density_kg_m3 + static_cast<double>(others.density[j]);
    const Vec3d u = others.velocity.template at<double>(j) - f.velocity.template at<double>(i);
    double pressures = static_cast<double>(f.pressure[i]) + static_cast<double>(others.pressure[j]);
    if (wall && p_.walls == WallModel::extrapolated) pressures = std::max(0.0, pressures);
    double viscosity = 0;
    if (dot(u, r) < 0) {
      const double mu = h_ * dot(u, r) / (distance * distance + 0.01 * h_ * h_);
      const double sound = 0.5 * (static_cast<double>(f.sound[i]) + static_cast<double>(others.sound[j]));
      viscosity = -p_.alpha * sound * mu / (0.5 * (density_i + density_j));
    }
    rates.acceleration += -m * (pressures / (density_i * density_j) + viscosity) * gradient;
    rates.density_rate += -m * dot(u, gradient);
    if (wall || distance == 0) return;
    rates.density_rate += 2 * p_.delta * h_ * p_.speed_of_sound_m_s * (density_j - density_i) * dot(r, gradient) /
                          (distance * distance) * m / density_j;
  }

  const WcsphSolver<Pack>& s_;
  const Parameters& p_;
  double h_;
};

template <class Pack>
void expect_rates_of_every_pair(WallModel walls) {
  const Scene scene = small_dam_break(walls, 2);
  Parameters p = small_parameters(scene, walls);
  p.alpha = 0.1;
  WcsphSolver<Pack> s(scene, p, 2);
  const double slack_m = s.sorted_fluid().index.geometry().slack_m;
  while (s.time_s() < 0.1 || s.sorted_fluid().travel_m < 0.8 * slack_m) s.step();
  Particles<Pack> fluid = s.fluid();
  sum_fluid_rates(fluid, s.sorted_fluid(), s.sorted_walls(), s.constants(), 2);
  const Plain<Pack> plain(s, p);
  double largest_acceleration = 0;
  double largest_rate = 0;
  double worst_acceleration = 0;
  double worst_rate = 0;
  for (std::size_t i = 0; i < fluid.n; ++i) {
    const Rates expected = plain.of(i);
    const Vec3d off = fluid.acceleration.template at<double>(i) - expected.acceleration;
    worst_acceleration = std::max(worst_acceleration, std::sqrt(dot(off, off)));
    worst_rate = std::max(worst_rate, std::abs(static_cast<double>(fluid.density_rate[i]) - expected.density_rate));
    largest_acceleration = std::max(largest_acceleration, std::sqrt(dot(expected.acceleration, expected.acceleration)));
    largest_rate = std::max(largest_rate, std::abs(expected.density_rate));
  }
  const double tolerance = sizeof(typename Lanes<Pack>::Real) == 8 ? 1e-9 : 1e-4;
  EXPECT_LT(worst_acceleration, tolerance * largest_acceleration);
  EXPECT_LT(worst_rate, tolerance * largest_rate);
}

TYPED_TEST(PairSums, AreThoseOfAllPairsWithDynamicWalls) {
  expect_rates_of_every_pair<TypeParam>(WallModel::dynamic);
}

TYPED_TEST(PairSums, AreThoseOfAllPairsWithExtrapolatedWalls) {
  expect_rates_of_every_pair<TypeParam>(WallModel::extrapolated);
}

TYPED_TEST(PairSums, PacksHoldTheirRunAndAreWrittenNoFurtherThanTheyMay) {
  constexpr std::int32_t width = Lanes<TypeParam>::width;
  const std::array<Run, 3> runs{{{5, 5}, {7, 7 + 5 * width + 1}, {200, 200 + width}}};
  for (const std::int32_t free : {0, 1, width - 1, width}) {
    std::array<std::int32_t, 3> ends;
    for (std::size_t k = 0; k < runs.size(); ++k) ends[k] = runs[k].end + free;
    PackList<TypeParam> packs;
    packs.list(runs, ends);
    std::array<std::int32_t, 3> next{5, 7, 200};
    for (const PackOfRun& pack : packs) {
      const std::size_t run = pack.begin < 200 ? 1 : 2;
      EXPECT_EQ(pack.begin, next[run]);
      next[run] += pack.count;
      EXPECT_EQ(pack.writable, pack.begin + width <= ends[run] ? width : pack.count);
    }
    for (std::size_t k = 0; k < runs.size(); ++k) EXPECT_EQ(next[k], runs[k].end);
  }
}

}  // namespace
}  // namespace sluice::wcsph
