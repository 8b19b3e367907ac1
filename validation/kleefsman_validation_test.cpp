// The quick tier of the Kleefsman dam break, run in full and held against every acceptance row of its case file.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "validation/acceptance.h"
#include "validation/case.h"
#include "validation/run.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct QuickRun {
  RunOutcome outcome;
  RunRecord record;
  std::vector<AcceptanceCheck> checks;
};

const Case& the_case() {
  static const Case c = load_case("kleefsman");
  return c;
}

QuickRun run_quick_tier(const std::string& solver) {
  const Tier& tier = *the_case().find_tier("quick");
  RunRequest request;
  request.solver = solver;
  request.l0_m = tier.l0_m;
  request.overrides = {{"t_end_s", tier.t_end_s}};
  RunOptions options;
  options.out = fs::temp_directory_path() / fmt::format("sluice-kleefsman-quick-{}-{}", solver, getpid());
  options.force = true;
  options.progress = stdout;
  QuickRun run;
  run.outcome = run_case(the_case(), resolve_settings(the_case(), request), options);
  if (run.outcome.status == "finished") {
    run.record = read_run(options.out);
    run.checks = check_acceptance(the_case(), run.record, Measurements::load(the_case()));
    fmt::print("{}", acceptance_table(run.checks));
  }
  fs::remove_all(options.out);
  return run;
}

/// Each solver runs once, with its default walls, for all the tests.
class KleefsmanQuickTier : public testing::TestWithParam<const char*> {
 protected:
  KleefsmanQuickTier() : run_(once(GetParam())) {}

  const QuickRun& run_;

 private:
  static const QuickRun& once(const std::string& solver) {
    static std::map<std::string, QuickRun> runs;
    const auto found = runs.find(solver);
    return found != runs.end() ? found->second : runs.emplace(solver, run_quick_tier(solver)).first->second;
  }
};

TEST_P(KleefsmanQuickTier, Finishes) {
  EXPECT_EQ(run_.outcome.status, "finished") << run_.outcome.error;
  EXPECT_GE(run_.record.number("time_s").value_or(0), 6.0);
}

TEST_P(KleefsmanQuickTier, EveryAcceptanceRowPasses) {
  int applicable = 0;
  for (const AcceptanceCheck& check : run_.checks) {
    if (check.verdict == AcceptanceVerdict::not_applicable) continue;
    ++applicable;
    EXPECT_EQ(check.verdict, AcceptanceVerdict::pass)
        << acceptance_name(check.row) << ": "
        << (check.value ? acceptance_value_text(check.row, *check.value) : check.reason) << ", band "
        << acceptance_band_text(check.row) << " (line " << check.row.line << " of the case file)";
  }
  EXPECT_GT(applicable, 0);
}

// The rows themselves: eight pressure sensors by impulse, peak and arrival, four probes by wave height.
TEST_P(KleefsmanQuickTier, RowsCoverEverySensorAndProbe) {
  std::set<std::string> covered;
  for (const AcceptanceCheck& check : run_.checks)
    if (check.verdict != AcceptanceVerdict::not_applicable) covered.insert(check.row.metric + " " + check.row.sensor);
  for (const CaseSensor& sensor : the_case().sensors) {
    if (sensor.kind == SensorKind::wave_height) {
      EXPECT_TRUE(covered.contains("rmse_over_range " + sensor.name)) << sensor.name;
      continue;
    }
    for (const char* metric : {"impulse_deviation ", "smoothed_peak_deviation ", "arrival_difference_s "})
      EXPECT_TRUE(covered.contains(metric + sensor.name)) << metric << sensor.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, KleefsmanQuickTier, testing::Values("wcsph", "mps"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace sluice
