#include "ci/made_results.h"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <random>

#include "ci/history.h"

namespace sluice::ci::made {
namespace {

constexpr int nights = 80;
constexpr std::time_t first_night_s = 1767236400;  // 2026-01-01T03:00:00Z

struct RunKind {
  std::string solver;
  std::string walls;
  double l0_m = 0;
};

Result of_kind(const RunKind& kind, int days, const std::string& metric, const std::string& of, double value,
               const std::string& unit) {
  Result r = result(days, metric, of, value, unit);
  r.solver = kind.solver;
  r.parameters = {{"l0_m", kind.l0_m}, {"walls", kind.walls}, {"t_end_s", 6.0}};
  r.run = fmt::format("{}-{}-{}", kind.solver, kind.l0_m, days);
  r.link = fmt::format("runs/nightly/{:03}/{}", days, r.run);
  return r;
}

void add_night(Ledger& ledger, const RunKind& kind, int days, std::mt19937_64& random) {
  std::normal_distribution<double> noise;
  const bool mps = kind.solver == "mps", fine = kind.l0_m < 0.025;
  const auto add = [&](const std::string& metric, const std::string& of, double value, const std::string& unit = "1") {
    ledger.results.push_back(of_kind(kind, days, metric, of, value, unit));
  };
  const double worse = mps && days >= 60 ? -0.055 : 0;
  const double p1 = (mps ? -0.046 : 0.03) * (fine ? 1 : 1.6) + worse;
  add("impulse_deviation", mps ? "P1 nearest" : "P1 wall", p1);
  add("impulse_deviation", mps ? "P2 nearest" : "P2 wall", 0.02 - p1 / 3);
  add("mean_impulse_error", "", std::abs(p1) + 0.02);
  add("arrival_difference_s", mps ? "P1 nearest" : "P1 wall", mps ? 0.028 : 0.015, "s");
  add("rmse_over_range", "H2 column", days >= 40 && !mps ? 0.072 : 0.06);
  if (mps && fine && days >= 77) {
    ledger.results.back().value.reset();
    ledger.results.back().reason = "no column H2_column_m";
  }
  add("lost_through_walls", "", 0, "particles");
  const double slower = !mps && days >= 50 ? 0.9 : 1;  // of time: WCSPH became faster
  const double time_s = (mps ? 900 : 700) * (fine ? 8 : 1) * slower * (1 + 0.012 * noise(random));
  add("cpu_time_s", "", time_s, "s");
  add("particle_steps_per_s", "", 4e9 / time_s, "1/s");
  add("phase_time_s", "sums", 0.7 * time_s, "s");
}

}  // namespace

std::string night(int days) {
  const std::time_t at = first_night_s + std::time_t{86400} * days;
  std::tm utc{};
  gmtime_r(&at, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

Result result(int days, const std::string& metric, const std::string& of, double value, const std::string& unit) {
  Result r;
  r.date = night(days);
  r.commit = fmt::format("c{:03}", days);
  r.machine = "a processor (1/2/3), 8 processors, 16 GiB";
  r.compiler = "g++ 12.2.0";
  r.flags = "-O3";
  r.threads = 8;
  r.inputs = "0123 4567";
  r.case_name = "kleefsman";
  r.solver = "wcsph";
  r.parameters = {{"l0_m", 0.02}, {"walls", "extrapolated"}};
  r.metric = metric;
  r.of = of;
  r.value = value;
  r.unit = unit;
  r.run = fmt::format("run-{}", days);
  r.link = fmt::format("runs/nightly/{:03}", days);
  return r;
}

Ledger example() {
  Ledger ledger;
  std::mt19937_64 random(42);
  for (int days = 0; days < nights; ++days) {
    for (const RunKind& kind : {RunKind{"wcsph", "extrapolated", 0.03}, RunKind{"wcsph", "extrapolated", 0.02},
                                RunKind{"mps", "dummies", 0.03}, RunKind{"mps", "dummies", 0.02}})
      add_night(ledger, kind, days, random);
    Result benchmark = result(days, "time_per_iteration_s", "wcsph/pair_sums/100000", 0.021, "s");
    *benchmark.value *= 1 + 0.01 * std::normal_distribution<double>()(random);
    benchmark.case_name = "benchmark";
    benchmark.parameters = nlohmann::json::object();
    benchmark.run = fmt::format("bench-{}", days);
    benchmark.link = fmt::format("https://example.org/bench/{}?a=1&b=2", days);
    ledger.results.push_back(benchmark);
  }
  for (const MetricSeries& series : series_of(ledger))
    if (series.key.metric == "rmse_over_range" && series.key.solver == "wcsph")
      ledger.acceptances.push_back({night(41), "a person", series.key.id(), night(40), "c040", 0.012,
                                    "the bed's friction <is> taken into account", false});
  ledger.damaged.push_back({17, "is not JSON"});
  return ledger;
}

}  // namespace sluice::ci::made
