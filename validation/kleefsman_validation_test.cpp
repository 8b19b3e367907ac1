// The quick tier of the Kleefsman dam break, run in full and held against every acceptance row of its case file.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "validation/acceptance.h"
#include "validation/case.h"
#include "validation/run.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

class KleefsmanQuickTier : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    the_case = load_case("kleefsman");
    const Tier& tier = *the_case.find_tier("quick");
    RunRequest request;
    request.walls = "extrapolated";
    request.l0_m = tier.l0_m;
    request.overrides = {{"alpha", 0.01}, {"t_end_s", tier.t_end_s}};
    RunOptions options;
    options.out = fs::temp_directory_path() / fmt::format("sluice-kleefsman-quick-{}", getpid());
    options.force = true;
    options.progress = stdout;
    outcome = run_case(the_case, resolve_settings(the_case, request), options);
    if (outcome.status != "finished") return;
    record = read_run(options.out);
    const MeasuredData measured = MeasuredData::load(resolve_in_source_tree(the_case.measured));
    checks = check_acceptance(the_case, record, &measured);
    fmt::print("{}", acceptance_table(checks));
    fs::remove_all(options.out);
  }

  static inline Case the_case;
  static inline RunOutcome outcome;
  static inline RunRecord record;
  static inline std::vector<AcceptanceCheck> checks;
};

TEST_F(KleefsmanQuickTier, Finishes) {
  EXPECT_EQ(outcome.status, "finished") << outcome.error;
  EXPECT_GE(record.number("time_s").value_or(0), 6.0);
}

TEST_F(KleefsmanQuickTier, EveryAcceptanceRowPasses) {
  int applicable = 0;
  for (const AcceptanceCheck& check : checks) {
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
TEST_F(KleefsmanQuickTier, RowsCoverEverySensorAndProbe) {
  std::set<std::string> covered;
  for (const AcceptanceCheck& check : checks)
    if (check.verdict != AcceptanceVerdict::not_applicable) covered.insert(check.row.metric + " " + check.row.sensor);
  for (const CaseSensor& sensor : the_case.sensors) {
    if (sensor.kind == SensorKind::wave_height) {
      EXPECT_TRUE(covered.contains("rmse_over_range " + sensor.name)) << sensor.name;
      continue;
    }
    for (const char* metric : {"impulse_deviation ", "smoothed_peak_deviation ", "arrival_difference_s "})
      EXPECT_TRUE(covered.contains(metric + sensor.name)) << metric << sensor.name;
  }
}

}  // namespace
}  // namespace sluice
