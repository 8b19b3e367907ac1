// What a report says of runs that end before the window does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/bias.h"
#include "reports/report.h"
#include "reports/sections.h"
#include "reports/studies.h"
#include "reports/synthetic_run.h"
#include "reports/tables.h"
#include "reports/test_files.h"
#include "reports/test_tables.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeRun;
using test_files::cell;
using test_files::fresh;
using testing::Contains;
using testing::HasSubstr;

TEST(EarlyRuns, AnInterruptedRunIsFlaggedAndHasNoImpulse) {
  const fs::path dir = fresh("interrupted");
  MadeRun run;
  run.t_end_s = 1.5;
  run.status = "interrupted";
  synthetic::write_run(dir, run);
  const ReportData data = analyse({dir});
  EXPECT_EQ(cell(runs_table(data), "R1", "status").text, "interrupted");
  EXPECT_NE(cell(runs_table(data), "R1", "remarks").text.find("covers 1.50 s"), std::string::npos);
  EXPECT_EQ(cell(paper_impulses_table(data), "R1", "P1_Pa_s").text, "missing");
}

TEST(EarlyRuns, AShortRunIsScoredOverWhatItCoversInATableOfItsOwn) {
  const fs::path dir = fresh("short");
  MadeRun run;
  run.t_end_s = 5.0;
  run.scale = 1.2;
  synthetic::write_run(dir, run);
  const Table table = early_runs_table(analyse({dir}));
  EXPECT_NEAR(*cell(table, "R1", "up_to_s").value, 5.0, 1e-9);
  EXPECT_NEAR(*cell(table, "R1", "P1_impulse_deviation_percent").value, 20, 0.1);
  EXPECT_NEAR(*cell(table, "R1", "P1_smoothed_peak_deviation_percent").value, 20, 3);
  EXPECT_GT(*cell(table, "R1", "H2_rmse_over_range_percent").value, 1);
  const fs::path whole = fresh("not_short");
  synthetic::write_run(whole, {});
  EXPECT_TRUE(early_runs_table(analyse({whole})).rows.empty());
  const Table beside = early_runs_table(analyse({whole, dir}));
  EXPECT_NEAR(*cell(beside, "R1", "up_to_s").value, 5.0, 1e-9) << "the whole run, over the same time";
  EXPECT_NEAR(*cell(beside, "R1", "P1_impulse_deviation_percent").value, 0, 0.1);
  EXPECT_NEAR(*cell(beside, "R2", "P1_impulse_deviation_percent").value, 20, 0.1);
  EXPECT_THAT(cell(beside, "R2", "run").text, testing::EndsWith("(ends there)"));
}

class WholeAndInterrupted : public testing::Test {
 protected:
  WholeAndInterrupted() {
    for (const std::string solver : {"mps", "wcsph"})
      for (const double l0_m : {0.02, 0.015}) {
        MadeRun run;
        run.solver = solver;
        run.walls = solver == "mps" ? "dummies" : "extrapolated";
        run.l0_m = l0_m;
        run.shift_s = 0.02;
        if (l0_m < 0.02) {
          run.shift_s = 0;
          run.t_end_s = 1.5;
          run.status = "interrupted";
        }
        directories.push_back(fresh("early_" + solver + (l0_m < 0.02 ? "_fine" : "_coarse")));
        synthetic::write_run(directories.back(), run);
      }
    data = analyse(directories);
  }
  std::vector<fs::path> directories;
  ReportData data;
};

TEST_F(WholeAndInterrupted, RankingsAreOfWholeRuns) {
  ASSERT_TRUE(ended_early(data, data.runs[1]));
  for (const KeyNumber& key : key_numbers(data)) EXPECT_THAT(key.remark, Not(HasSubstr("l0 15 mm"))) << key.label;
  const std::vector<std::string> found = findings(data);
  EXPECT_THAT(found, Contains(HasSubstr("Ended early: R2 and R4.")));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("**Arrival**"), HasSubstr("+20 ms"), Not(HasSubstr("15 mm")))));
  const ReportData alone = analyse({directories[1]});
  EXPECT_THAT(findings(alone), Contains(AllOf(HasSubstr("**Arrival**"), HasSubstr("15 mm")))) << "better than nothing";
}

TEST_F(WholeAndInterrupted, MeansAndRatiosAreOfWholeRuns) {
  const Table cost = cost_ratio_table(data);
  EXPECT_EQ(cost.rows.size(), 2U) << "one pair, and the paper's";
  EXPECT_THAT(cost.notes, Contains("Left out, since they ended early: R2, R4."));
  EXPECT_TRUE(resolution_series(data).empty());
  for (const BiasQuantity& quantity : bias_quantities(data))
    for (const BiasMethod& method : quantity.methods) EXPECT_LE(method.pairs.size(), 8U) << quantity.name;
  EXPECT_EQ(cell(kernel_support_table(data), "R2", "P1_percent").text, "missing");
  EXPECT_EQ(cell(kernel_support_table(data), "R1", "P1_percent").value, 100);
}

/// A trial to 2 s is finished, and still knows nothing of what comes after.
TEST(EarlyRuns, AFinishedRunThatIsShorterThanTheWindowStandsBesideNoWholeOne) {
  const fs::path whole = fresh("beside_trial");
  const fs::path trial = fresh("trial");
  synthetic::write_run(whole, {});
  synthetic::write_run(trial, {.l0_m = 0.015, .t_end_s = 2.0});
  test_files::put_in_manifest(trial, {{"t_end_s", 2.0}});
  const ReportData data = analyse({whole, trial});
  EXPECT_FALSE(ended_early(data, data.runs[0]));
  EXPECT_TRUE(ended_early(data, data.runs[1]));
  EXPECT_EQ(left_out_note(data), "Left out, since they ended early: R2.");
  EXPECT_EQ(cell(conservation_table(data), "R2", "energy_end_percent").text, "missing");
  EXPECT_EQ(cell(kernel_support_table(data), "R2", "P1_percent").text, "missing");
  const ReportData alone = analyse({trial});
  EXPECT_FALSE(ended_early(alone, alone.runs[0]));
  EXPECT_NE(cell(conservation_table(alone), "R1", "energy_end_percent").text, "missing");
}

}  // namespace
}  // namespace sluice
