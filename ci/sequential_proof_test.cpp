// What the alarm is worth, on synthetic histories: the check is asked every night of a year, on 200 series of noise,
// and on series with a planted step. Noise of four kinds, all with standard deviation one, so that a step of five is
// one of five standard deviations of what the nights scatter by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "ci/shifts.h"

namespace sluice::ci {
namespace {

using Random = std::mt19937_64;
using Values = std::vector<double>;

constexpr std::size_t nights_a_year = 365;
constexpr int series_count = 200;
constexpr int planted_steps = 600;  // of each kind, and year
constexpr double share_to_find = 0.95;

struct Noise {
  std::string name;
  std::function<Values(Random&, std::size_t)> draw;
  bool promised = true;  ///< false: beyond what the rule is made for, measured only
};

/// SLUICE_PROOF_YEARS: for the figures of ci/README.md, where one year is no good estimate of a rate.
int years() {
  const char* given = std::getenv("SLUICE_PROOF_YEARS");
  return given == nullptr ? 1 : std::max(1, std::atoi(given));
}

Values independent(std::size_t n, const std::function<double()>& one) {
  Values values(n);
  for (double& value : values) value = one();
  return values;
}

/// x[k] = r x[k-1] + sqrt(1 - r^2) e[k]: a warm machine is warm the next night, too.
Values autoregressive(Random& random, std::size_t n, double r) {
  std::normal_distribution<double> normal;
  Values values(n);
  double x = normal(random);
  for (double& value : values) {
    value = x;
    x = r * x + std::sqrt(1 - r * r) * normal(random);
  }
  return values;
}

const std::vector<Noise>& noises() {
  static const std::vector<Noise> all{
      {"normal",
       [](Random& random, std::size_t n) {
         std::normal_distribution<double> normal;
         return independent(n, [&] { return normal(random); });
       }},
      {"Student's t with four degrees of freedom: heavy tails",
       [](Random& random, std::size_t n) {
         std::student_t_distribution<double> student(4);
         return independent(n, [&] { return student(random) / std::sqrt(2.0); });
       }},
      {"autoregressive, correlation 0.2 from night to night",
       [](Random& random, std::size_t n) { return autoregressive(random, n, 0.2); }},
      {"log-normal, 0.3: a long tail to one side, as times have",
       [](Random& random, std::size_t n) {
         const double s = 0.3, scale = std::sqrt((std::exp(s * s) - 1) * std::exp(s * s));
         std::normal_distribution<double> normal;
         return independent(n, [&] { return std::exp(s * normal(random)) / scale; });
       }},
      {"autoregressive, correlation 0.3: beyond the limit",
       [](Random& random, std::size_t n) { return autoregressive(random, n, 0.3); }, false},
  };
  return all;
}

/// What is promised; where figures are asked for, what is not, too.
std::vector<Noise> noises_to_try() {
  std::vector<Noise> chosen;
  for (const Noise& noise : noises())
    if (noise.promised || years() > 1) chosen.push_back(noise);
  return chosen;
}

/// Found: a shift of the right sign is told, and begins within three nights of the step.
bool is_found(const Values& values, std::size_t step_at, double size) {
  for (const Shift& shift : find_shifts(values, {}))
    if (shift.found >= step_at && shift.first + 3 >= step_at && shift.first <= step_at + 3 &&
        (shift.after > shift.before) == (size > 0))
      return true;
  return false;
}

/// Share of steps of a size [standard deviations] that are found within `limit` nights, the night of the step included.
/// Histories before it are 30 to 90 nights long.
double share_found(const Noise& noise, double size, std::size_t limit, std::uint64_t seed) {
  Random random(seed);
  int found = 0;
  const int steps = planted_steps * years();
  for (int k = 0; k < steps; ++k) {
    const auto step_at = static_cast<std::size_t>(30 + k % 61);
    Values values = noise.draw(random, step_at + limit);
    for (std::size_t i = step_at; i < values.size(); ++i) values[i] += size;
    found += is_found(values, step_at, size);
  }
  return static_cast<double>(found) / steps;
}

// Each night's answer follows from that night and those before it (shifts_test.cpp shows it), so that one replay is a
// year of nightly checks. Turns for the better count as well as those for the worse.
TEST(SequentialProof, AtMostOneFalseAlarmAYearOver200Series) {
  std::uint64_t seed = 1;
  for (const Noise& noise : noises_to_try()) {
    Random random(seed++);
    int alarms = 0;
    for (int k = 0; k < series_count * years(); ++k)
      alarms += static_cast<int>(find_shifts(noise.draw(random, nights_a_year), {}).size());
    if (noise.promised) {
      EXPECT_LE(alarms, years()) << noise.name;
    }
    std::cout << noise.name << ": " << alarms << " false alarms in " << years() << " year(s) of " << series_count
              << " series\n";
  }
}

TEST(SequentialProof, StepsOfFiveScattersAreFoundWithinFourNights) {
  for (const Noise& noise : noises_to_try())
    for (const double size : {5.0, -5.0}) {
      const double share = share_found(noise, size, 4, 5);
      if (noise.promised) {
        EXPECT_GE(share, share_to_find) << noise.name << ", step " << size;
      }
      std::cout << noise.name << ": " << 100 * share << " % of steps of " << size << " found within 4 nights\n";
    }
}

TEST(SequentialProof, StepsOfThreeScattersAreFoundWithinTwelveNights) {
  for (const Noise& noise : noises_to_try())
    for (const double size : {3.0, -3.0}) {
      const double share = share_found(noise, size, 12, 3);
      if (noise.promised) {
        EXPECT_GE(share, share_to_find) << noise.name << ", step " << size;
      }
      std::cout << noise.name << ": " << 100 * share << " % of steps of " << size << " found within 12 nights\n";
    }
}

// Why E-divisive with its significance test is not enough by itself: at its usual five per cent, asked every night, it
// would call on every other night.
TEST(SequentialProof, SignificanceAloneWouldCryWolf) {
  Random random(1);
  int nights_with_change = 0, nights = 0;
  EDivisiveOptions usual;
  usual.significance = 0.05;
  for (int k = 0; k < 4; ++k) {
    const Values values = noises().front().draw(random, 150);
    for (std::size_t night = 30; night < values.size(); ++night, ++nights) {
      const auto window = std::span(values).first(night).last(std::min<std::size_t>(night, 90));
      nights_with_change += !e_divisive(window, usual).empty();
    }
  }
  const double over_200_series = 200.0 * nights_with_change / nights;
  EXPECT_GT(over_200_series, 1) << "a night, over 200 series";
  std::cout << "significance alone: " << over_200_series << " of 200 series call on an average night\n";
}

}  // namespace
}  // namespace sluice::ci
