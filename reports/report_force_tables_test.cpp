// Tables of cases with forces: measured ones, and one whose measurement a user has to supply.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "reports/report.h"
#include "reports/studies.h"
#include "reports/synthetic_run.h"
#include "reports/tables.h"
#include "reports/test_files.h"
#include "reports/test_tables.h"
#include "validation/digest.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeForceRun;

using test_files::cell;
using test_files::fresh;
using test_files::put_in_manifest;

TEST(ForceTables, KnownScaleAndShiftGiveKnownNumbersByBothRoutes) {
  const fs::path dir = fresh("force_known");
  MadeForceRun run;
  run.scale = 1.1;
  run.second_scale = 0.7;
  synthetic::write_force_run(dir, run);
  const ReportData data = analyse({dir});
  const Table impulses = force_impulses_table(data, "F_column");
  EXPECT_NEAR(*cell(impulses, "Experiment", "impulse_0.3_1.3_s_N_s").value, 13.35, 0.01);
  EXPECT_NEAR(*cell(impulses, "R1", "impulse_0.3_1.3_s_deviation_percent", "acceleration").value, 10, 0.5);
  EXPECT_NEAR(*cell(impulses, "R1", "impulse_0.3_1.3_s_deviation_percent", "pressure").value, -30, 0.5);
  EXPECT_NEAR(*cell(impulses, "R1", "impulse_1.4_2.3_s_deviation_percent", "acceleration").value, 10, 1);
  EXPECT_GT(*cell(impulses, "R1", "inside_band_percent", "acceleration").value, 30);
  run.scale = 1;
  run.shift_s = 0.02;
  synthetic::write_force_run(dir, run);
  const Table peaks = force_peaks_table(analyse({dir}));
  // A line through bin means rises less steeply than the band's points: some milliseconds.
  EXPECT_NEAR(*cell(peaks, "R1", "half_peak_difference_ms", "acceleration").value, 20, 3);
}

TEST(ForceTables, MeanOfTheBandLiesInsideIt) {
  const fs::path dir = fresh("force_band");
  synthetic::write_force_run(dir, {});
  const Table table = force_impulses_table(analyse({dir}), "F_column");
  EXPECT_GT(*cell(table, "R1", "inside_band_percent", "acceleration").value, 75);
  EXPECT_LT(*cell(table, "R1", "rmse_over_range_percent", "acceleration").value, 2);
}

TEST(ForceTables, AcceptanceOfTheColumn) {
  const fs::path good = fresh("force_accept_good");
  const fs::path bad = fresh("force_accept_bad");
  MadeForceRun run;
  synthetic::write_force_run(good, run);
  run.alpha = 0.001;
  run.shift_s = 0.04;
  run.scale = 1.3;
  synthetic::write_force_run(bad, run);
  const ReportData data = analyse({good, bad});
  EXPECT_TRUE(all_passed(data.runs[0].acceptance)) << acceptance_table(data.runs[0].acceptance);
  int failed = 0;
  for (const AcceptanceCheck& check : data.runs[1].acceptance) failed += check.verdict == AcceptanceVerdict::fail;
  EXPECT_EQ(failed, 3) << acceptance_table(data.runs[1].acceptance);
}

TEST(ForceTables, PeakAndImpulseConvergeOrSayThatTheyDoNot) {
  std::vector<fs::path> dirs;
  MadeForceRun run;
  run.case_name = "aureli";
  for (double l0 : {0.04, 0.02, 0.01}) {
    dirs.push_back(fresh("force_resolution_" + std::to_string(dirs.size())));
    run.l0_m = l0;
    run.scale = 1 + 100 * l0 * l0;
    synthetic::write_force_run(dirs.back(), run);
  }
  const Table table = resolution_table(analyse(dirs));
  EXPECT_TRUE(cell(table, "F_block peak", "observed_order").text.starts_with("order 2.0"));
  EXPECT_NE(cell(table, "F_block impulse", "observed_order").text.find("grid convergence index"), std::string::npos);
  EXPECT_NEAR(*cell(table, "F_block impulse", "l0_40_mm").value, 1.16, 0.01) << "10 N over 0.1 s";
  put_in_manifest(dirs[0], {{"fitted_lengths", nlohmann::json::array()}});
  put_in_manifest(dirs[1],
                  {{"fitted_lengths", {{{"name", "block.upper.x"}, {"nominal_m", 1.265}, {"fitted_m", 1.285}}}}});
  put_in_manifest(dirs[2], {{"fitted_lengths", nlohmann::json::array()}});
  const Table other_body = resolution_table(analyse(dirs));
  EXPECT_EQ(cell(other_body, "F_block peak", "observed_order").text, "none: geometries differ");
  put_in_manifest(dirs[1], {{"fitted_lengths", nlohmann::json::array()}});
  run.scale = 3;
  synthetic::write_force_run(dirs.back(), run);
  EXPECT_EQ(cell(resolution_table(analyse(dirs)), "F_block impulse", "observed_order").text,
            "not in the asymptotic range");
}

TEST(ForceTables, ErrorsStandBesideWhatIsUncertain) {
  std::vector<fs::path> runs;
  MadeForceRun made;
  for (const double l0_m : {0.04, 0.02, 0.01}) {  // first order towards 1.1
    runs.push_back(fresh("force_uncertain_" + std::to_string(runs.size())));
    made.l0_m = l0_m;
    made.scale = 1.1 + 5 * l0_m;
    synthetic::write_force_run(runs.back(), made);
  }
  const Table table = validation_uncertainty_table(analyse(runs));
  const double measured = *cell(table, "F_column impulse", "measured").value;
  EXPECT_NEAR(*cell(table, "F_column impulse", "error").value, 0.15 * measured, 0.01 * measured);
  EXPECT_NEAR(*cell(table, "F_column impulse", "u_num").value, 3 / 1.15 * 0.05 * measured, 0.012 * measured)
      << "an order that is not the formal one";
  EXPECT_GT(*cell(table, "F_column impulse", "u_D").value, 0.5) << "[N s]: a band of 1.4 N over two seconds";
  EXPECT_EQ(cell(table, "F_column impulse", "u_input").text, "missing");
}

TEST(ForceTables, SeriesWithoutAMeasurementLeaveNoHeadings) {
  std::vector<fs::path> runs;
  const auto write_series = [&](const std::string& case_name) {
    runs.clear();
    for (const double l0_m : {0.025, 0.0125})
      for (const double alpha : {0.1, 0.01}) {
        runs.push_back(fresh(fmt::format("force_headings_{}", runs.size())));
        MadeForceRun made;
        made.case_name = case_name;
        made.l0_m = l0_m;
        made.alpha = alpha;
        synthetic::write_force_run(runs.back(), made);
      }
  };
  write_series("aureli");
  const ReportData unmeasured = analyse(runs);
  ASSERT_EQ(alpha_series(unmeasured).size(), 2u);
  EXPECT_TRUE(best_alpha_table(unmeasured).rows.empty());
  EXPECT_TRUE(validation_uncertainty_table(unmeasured).rows.empty());
  const fs::path out = fresh("force_headings_out");
  ReportOptions options;
  options.figures = false;
  write_report(runs, out, options);
  EXPECT_FALSE(fs::exists(out / "tables/best_alpha.csv"));
  write_series("column");
  const Table best = best_alpha_table(analyse(runs));
  ASSERT_EQ(best.rows.size(), 6u) << "a heading and two quantities of each series";
  EXPECT_TRUE(best.rows[0].is_group());
  EXPECT_TRUE(best.rows[3].is_group());
}

TEST(ForceTables, StatementsOnTheForceNeedAMeasurementOrNot) {
  const fs::path viscous = fresh("force_statement_viscous");
  const fs::path thin = fresh("force_statement_thin");
  const fs::path mps = fresh("force_statement_mps");
  MadeForceRun run;
  run.case_name = "aureli";
  run.l0_m = 0.01;
  run.alpha = 0.1;
  run.noise_N = 0.2;
  synthetic::write_force_run(viscous, run);
  run.alpha = 0.01;
  run.noise_N = 0.5;
  synthetic::write_force_run(thin, run);
  run.solver = "mps";
  run.walls = "dummies";
  synthetic::write_force_run(mps, run);
  const Table table = conclusions_table(analyse({viscous, thin, mps}));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(cell(table, "α = 0.1 gives the best force", "verdict").text, "no measurement");
  EXPECT_EQ(cell(table, "Oscillations", "verdict").text, "agrees") << cell(table, "Oscillations", "runs").text;
  EXPECT_EQ(cell(table, "MPS costs", "paper").text, "1.25 times at l0 = 5 mm, 1.97 times at l0 = 2.5 mm");
  EXPECT_EQ(cell(table, "MPS costs 1.97 times WCSPH", "verdict").text, "does not agree") << "the same cost";
}

/// Of two runs at one alpha neither comes after the other: what their folders are called must not decide.
TEST(ForceTables, AVerdictDoesNotHangOnTheNamesOfFolders) {
  for (const bool swapped : {false, true}) {
    std::vector<fs::path> runs;
    const auto write = [&](const std::string& name, double alpha, double noise_N) {
      runs.push_back(fresh("force_names_" + name));
      MadeForceRun run;
      run.case_name = "aureli";
      run.alpha = alpha;
      run.noise_N = noise_N;
      synthetic::write_force_run(runs.back(), run);
    };
    write("a", 0.1, swapped ? 0.2 : 0.3);
    write("b", 0.1, swapped ? 0.3 : 0.2);
    write("c", 0.01, 0.5);
    const Table table = conclusions_table(analyse(runs));
    EXPECT_EQ(cell(table, "Oscillations", "verdict").text, "agrees") << cell(table, "Oscillations", "runs").text;
  }
}

TEST(ForceTables, CostsAreComparedOnOneMachineAndWithThePapersAtThatDistance) {
  const fs::path wcsph = fresh("force_cost_wcsph");
  const fs::path mps = fresh("force_cost_mps");
  MadeForceRun run;
  run.case_name = "aureli";
  run.l0_m = 0.005;
  synthetic::write_force_run(wcsph, run);
  run.solver = "mps";
  run.walls = "dummies";
  synthetic::write_force_run(mps, run);
  put_in_manifest(wcsph, {{"cpu_time_s", 1000.0}, {"machine", "one"}});
  put_in_manifest(mps, {{"cpu_time_s", 1250.0}, {"machine", "one"}});
  const char* const statement = "MPS costs 1.25 times WCSPH";
  EXPECT_EQ(cell(conclusions_table(analyse({wcsph, mps})), statement, "verdict").text, "agrees") << "1.25 at 5 mm";
  put_in_manifest(mps, {{"machine", "another"}});
  EXPECT_EQ(cell(conclusions_table(analyse({wcsph, mps})), "MPS costs", "verdict").text, "missing");
}

TEST(ForceTables, LengthsThatSourcesLeaveOpenHaveTheirTableAndAreNoResolutionOrAlpha) {
  const fs::path near = fresh("force_placement_near");
  const fs::path far = fresh("force_placement_far");
  MadeForceRun run;
  run.case_name = "aureli";
  run.l0_m = 0.02;
  synthetic::write_force_run(far, run);
  run.parameters = {{"block_distance_m", 0.45}};
  run.shift_s = -0.05;
  run.alpha = 0.1;
  synthetic::write_force_run(near, run);
  EXPECT_TRUE(placements_table(analyse({near, far})).rows.empty()) << "they differ in alpha too";
  EXPECT_TRUE(alpha_series(analyse({near, far})).empty()) << "and in the place of the block";
  run.alpha = 0.01;
  synthetic::write_force_run(near, run);
  const ReportData data = analyse({near, far});
  const Table table = placements_table(data);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(*table.rows[1].cells[2].value, 0.45);
  EXPECT_NEAR(*table.rows[2].cells[3].value - *table.rows[1].cells[3].value, 0.05, 1e-6) << "arrival";
  EXPECT_TRUE(resolution_series(data).empty());
  for (const AnalysedRun& r : data.runs) {
    const double drawn_m = data.the_case.obstacles.back().box.upper.x;
    const double at_m = placed_at_m(data.the_case.placements.front(), r.record);
    EXPECT_NEAR(placed_obstacles(data.the_case, r.record).back().box.upper.x, drawn_m + 0.51 - at_m, 1e-12);
  }
}

TEST(ForceTables, RunsOfOtherParametersAreNoResolutionOrAlphaStudy) {
  MadeForceRun run;
  std::vector<fs::path> directories;
  for (const double l0_m : {0.02, 0.0125, 0.01}) {
    run.l0_m = l0_m;
    directories.push_back(fresh(fmt::format("force_method_{}", l0_m)));
    synthetic::write_force_run(directories.back(), run);
  }
  const auto all = resolution_series(analyse(directories));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].runs.size(), 3u);

  run.l0_m = 0.0125;
  run.parameters = {{"delta", 0.02}};
  synthetic::write_force_run(directories[1], run);
  run.alpha = 0.1;
  run.parameters = {};
  directories.push_back(fresh("force_method_alpha"));
  synthetic::write_force_run(directories.back(), run);
  const ReportData data = analyse(directories);
  const auto alike = resolution_series(data);
  ASSERT_EQ(alike.size(), 1u);
  EXPECT_EQ(alike[0].runs.size(), 2u);
  EXPECT_TRUE(alpha_series(data).empty()) << "delta differs as well";
}

TEST(ForceTables, WallsAreComparedBetweenRunsOfTheSameParameters) {
  MadeForceRun run;
  const std::vector<fs::path> directories{fresh("force_walls_ours"), fresh("force_walls_paper")};
  synthetic::write_force_run(directories[0], run);
  run.walls = "dynamic";
  synthetic::write_force_run(directories[1], run);
  EXPECT_EQ(wall_pairs(analyse(directories)).size(), 1u);
  run.parameters = {{"not_in_the_case_file", 1}};
  synthetic::write_force_run(directories[1], run);
  EXPECT_TRUE(wall_pairs(analyse(directories)).empty());
}

}  // namespace
}  // namespace sluice
