// The paper's statements, judged by runs whose errors are known.
#include <gtest/gtest.h>

#include <algorithm>

#include "reports/report.h"
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

TEST(ReportTables, ThePapersStatementsAreJudgedByTheRuns) {
  const fs::path wcsph = fresh("statements_wcsph");
  const fs::path viscous = fresh("statements_viscous");
  const fs::path mps = fresh("statements_mps");
  MadeRun run;
  run.alpha = 0.001;
  run.scale = 0.9;
  synthetic::write_run(wcsph, run);
  const Table alone = conclusions_table(analyse({wcsph}));
  ASSERT_EQ(alone.rows.size(), 7U);
  EXPECT_EQ(alone.rows[0].cells[3].text, "missing");
  EXPECT_EQ(alone.rows[1].cells[3].text, "agrees") << "all too low";
  run.alpha = 0.1;
  run.scale = 0.7;
  synthetic::write_run(viscous, run);
  run = {};
  run.solver = "mps";
  run.walls = "dummies";
  run.scale = 1.2;
  synthetic::write_run(mps, run);
  const Table table = conclusions_table(analyse({wcsph, viscous, mps}));
  EXPECT_EQ(table.rows[0].cells[1].text, "MPS 7.8 %, WCSPH 24.1 % to 36.2 %");
  EXPECT_EQ(table.rows[0].cells[3].text, "does not agree") << "20 % against 10 %";
  EXPECT_EQ(table.rows[2].cells[3].text, "agrees") << table.rows[2].cells[2].text;
  EXPECT_EQ(cell(table, "MPS costs 1.77 times WCSPH", "paper").text, "1.77 times");
  EXPECT_EQ(cell(table, "MPS costs 1.77 times WCSPH", "verdict").text, "does not agree") << "the same cost";
  EXPECT_EQ(cell(table, "WCSPH takes many more steps than MPS", "paper").text, "7.9 times");
}

/// Ours too high, the paper's too low: pooled they would say that WCSPH is as good as the better of them.
TEST(ReportTables, EachWallModelHasItsOwnVerdict) {
  std::vector<fs::path> runs;
  const auto write = [&](const MadeRun& made) {
    runs.push_back(fresh("statement_walls_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), made);
  };
  write({.alpha = 0.1, .scale = 1.1});
  write({.alpha = 0.001, .scale = 1.2});
  write({.solver = "mps", .walls = "dummies", .scale = 0.8});
  EXPECT_EQ(conclusions_table(analyse(runs)).rows[0].cells[0].text, "MPS is more accurate in impulse")
      << "one wall model needs no name";
  write({.walls = "dynamic", .l0_m = 0.03, .alpha = 0.1, .scale = 0.5});
  write({.walls = "dynamic", .l0_m = 0.03, .alpha = 0.001, .scale = 0.6});
  write({.solver = "mps", .walls = "dummies", .l0_m = 0.03, .scale = 0.8});
  const Table table = conclusions_table(analyse(runs));
  const auto verdict = [&](const std::string& statement, const std::string& walls) {
    return cell(table, statement + ", " + walls, "verdict").text;
  };
  EXPECT_EQ(verdict("MPS is more accurate in impulse", "extrapolated walls"), "does not agree") << "20 % against 10 %";
  EXPECT_EQ(verdict("MPS is more accurate in impulse", "dynamic walls (the paper's)"), "agrees") << "20 against 40 %";
  EXPECT_EQ(verdict("WCSPH underestimates the impulses", "extrapolated walls"), "does not agree");
  EXPECT_EQ(verdict("WCSPH underestimates the impulses", "dynamic walls (the paper's)"), "agrees");
  EXPECT_EQ(verdict("α ≤ 0.001 gives better impulses", "extrapolated walls"), "does not agree");
  EXPECT_EQ(verdict("α ≤ 0.001 gives better impulses", "dynamic walls (the paper's)"), "agrees");
  EXPECT_EQ(cell(table, "WCSPH underestimates the impulses, dynamic", "runs").text, "6 of 6 impulses too low");
  EXPECT_TRUE(cell(table, "MPS is more accurate in impulse, dynamic", "runs").text.ends_with("l0 30 mm)"))
      << "the finest that has both with these walls";
}

TEST(ReportTables, StatementsOnWaveHeightsAndOnOscillationsOfPressures) {
  const fs::path thin = fresh("statement_thin");
  const fs::path viscous = fresh("statement_viscous");
  const fs::path mps = fresh("statement_quiet");
  const std::string waves = "α ≤ 0.01 gives better wave heights";
  const std::string noise = "MPS pressures oscillate less than WCSPH's";
  synthetic::write_run(viscous, {.alpha = 0.1, .scale = 0.8, .noise_Pa = 300});
  synthetic::write_run(thin, {.scale = 0.95, .noise_Pa = 400});
  const Table alone = conclusions_table(analyse({thin, viscous}));
  EXPECT_EQ(cell(alone, noise, "verdict").text, "missing") << "no MPS";
  synthetic::write_run(mps, {.solver = "mps", .walls = "dummies", .noise_Pa = 50});
  const Table good = conclusions_table(analyse({thin, viscous, mps}));
  EXPECT_EQ(cell(good, waves, "paper").text, "its figures 4, 5, 6; no numbers are printed");
  EXPECT_EQ(cell(good, waves, "verdict").text, "agrees") << cell(good, waves, "runs").text;
  EXPECT_EQ(cell(good, noise, "paper").text, "its figures 7, 8, 9; no numbers are printed");
  EXPECT_EQ(cell(good, noise, "verdict").text, "agrees") << cell(good, noise, "runs").text;
  synthetic::write_run(thin, {.scale = 0.7, .noise_Pa = 400});
  synthetic::write_run(mps, {.solver = "mps", .walls = "dummies", .noise_Pa = 1000});
  const Table bad = conclusions_table(analyse({thin, viscous, mps}));
  EXPECT_EQ(cell(bad, waves, "verdict").text, "does not agree") << cell(bad, waves, "runs").text;
  EXPECT_EQ(cell(bad, noise, "verdict").text, "does not agree") << cell(bad, noise, "runs").text;
}

TEST(ReportTables, WhatRunsScatterByDecidesNothing) {
  std::vector<fs::path> runs;
  const auto write = [&](const MadeRun& made) {
    runs.push_back(fresh("statement_scatter_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), made);
  };
  write({.alpha = 0.001, .scale = 0.80});
  write({.alpha = 0.01, .scale = 0.81});
  write({.alpha = 0.1, .scale = 0.60});
  write({.solver = "mps", .walls = "dummies", .scale = 0.805});
  const Table table = conclusions_table(analyse(runs));
  EXPECT_EQ(cell(table, "MPS is more accurate in impulse", "verdict").text, "no difference told");
  EXPECT_EQ(cell(table, "α ≤ 0.001 gives better impulses", "verdict").text, "no difference told")
      << "0.01 is as good, whatever 0.1 does to a mean";
  EXPECT_NE(cell(table, "α ≤ 0.001 gives better impulses", "runs").text.find("40.0 % at 0.1"), std::string::npos);
}

/// The errors of kleefsman-alpha and kleefsman-standard with extrapolated walls.
TEST(ReportTables, ErrorsOnBothSidesOfAnAlphaThatOverlapTellNoDifference) {
  const std::string statement = "α ≤ 0.001 gives better impulses";
  std::vector<fs::path> runs;
  const auto write = [&](double alpha, double scale) {
    runs.push_back(fresh("statement_overlap_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), {.alpha = alpha, .scale = scale});
  };
  write(0.0001, 1.0682);
  write(0.001, 1.0660);
  write(0.01, 1.0684);
  write(0.1, 1.0557);
  EXPECT_EQ(cell(conclusions_table(analyse(runs)), statement, "verdict").text, "no difference told")
      << "the best is large by a tenth and more, the worst is large too";
  runs.erase(runs.begin() + 2);
  EXPECT_EQ(cell(conclusions_table(analyse(runs)), statement, "verdict").text, "does not agree");
  write(0.01, 1.0630);
  EXPECT_EQ(cell(conclusions_table(analyse(runs)), statement, "verdict").text, "no difference told")
      << "all large ones are better, one of them by less than a tenth";
}

/// The paper's campaign computes with parameters of its own throughout.
TEST(ReportTables, RunsThatAllHaveOtherParametersStandForTheirMethod) {
  const fs::path wcsph = fresh("statement_as_printed");
  const fs::path cut = fresh("statement_cut");
  const fs::path mps = fresh("statement_as_printed_mps");
  synthetic::write_run(wcsph, {.scale = 0.7});
  test_files::put_in_manifest(wcsph, {{"parameters", {{"tension_limit", 1.0}}}});
  synthetic::write_run(mps, {.solver = "mps", .walls = "dummies", .scale = 0.9});
  const Table table = conclusions_table(analyse({wcsph, mps}));
  EXPECT_EQ(cell(table, "MPS is more accurate in impulse", "verdict").text, "agrees");
  EXPECT_TRUE(std::any_of(table.notes.begin(), table.notes.end(), [](const std::string& note) {
    return note.find("WCSPH is judged by its runs with tension_limit = 1") != std::string::npos;
  }));
  synthetic::write_run(cut, {.scale = 1.3});
  test_files::put_in_manifest(cut, {{"parameters", {{"delta", 0.02}}}});
  test_files::put_in_manifest(wcsph, {{"parameters", {{"tension_limit", nullptr}}}});
  EXPECT_EQ(cell(conclusions_table(analyse({wcsph, cut, mps})), "WCSPH underestimates the impulses", "runs").text,
            "3 of 3 impulses too low")
      << "an ablation says nothing of the method";
}

/// The paper's walls with the paper's parameters beside our own walls with the case's.
TEST(ReportTables, EachWallModelIsJudgedByParametersOfItsOwn) {
  std::vector<fs::path> runs;
  const auto write = [&](const MadeRun& made) {
    runs.push_back(fresh("statement_parameters_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), made);
  };
  write({.scale = 0.95});
  write({.walls = "dynamic", .scale = 0.7});
  test_files::put_in_manifest(runs.back(), {{"parameters", {{"tension_limit", 1.0}}}});
  write({.solver = "mps", .walls = "dummies", .scale = 0.9});
  const Table table = conclusions_table(analyse(runs));
  EXPECT_EQ(cell(table, "MPS is more accurate in impulse, dynamic", "verdict").text, "agrees");
  EXPECT_EQ(cell(table, "MPS is more accurate in impulse, extrapolated", "verdict").text, "does not agree");
  EXPECT_EQ(cell(table, "WCSPH underestimates the impulses, dynamic", "runs").text, "3 of 3 impulses too low");
}

TEST(ReportTables, AShortTrialDoesNotHideWholeRuns) {
  std::vector<fs::path> runs;
  const auto write = [&](const MadeRun& made, double t_end_s) {
    runs.push_back(fresh("statement_trial_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), made);
    test_files::put_in_manifest(runs.back(), {{"t_end_s", t_end_s}});
  };
  for (const double t_end_s : {6.0, 0.5}) {
    const double l0_m = t_end_s < 1 ? 0.015 : 0.02;
    write({.l0_m = l0_m, .scale = 0.7, .t_end_s = t_end_s}, t_end_s);
    write({.solver = "mps", .walls = "dummies", .l0_m = l0_m, .scale = 0.9, .t_end_s = t_end_s}, t_end_s);
  }
  EXPECT_EQ(cell(conclusions_table(analyse(runs)), "MPS is more accurate in impulse", "verdict").text, "agrees");
  runs.erase(runs.begin() + 1);  // of the whole ones WCSPH alone is left
  EXPECT_NE(cell(conclusions_table(analyse(runs)), "WCSPH takes many more steps than MPS", "verdict").text, "missing")
      << "short runs of both are better than none";
}

}  // namespace
}  // namespace sluice
