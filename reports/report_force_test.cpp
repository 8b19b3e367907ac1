// Whole reports on cases with forces.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "reports/figures.h"
#include "reports/report.h"
#include "reports/studies.h"
#include "reports/synthetic_run.h"
#include "reports/test_files.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeForceRun;

using test_files::fresh;
using test_files::read;

TEST(ForceReport, ThePapersFigure12HasBothMethodsInOnePanelAParticleDistance) {
  std::vector<fs::path> runs;
  MadeForceRun made;
  made.case_name = "aureli";
  const auto add = [&] {
    runs.push_back(fresh("force_methods_" + std::to_string(runs.size())));
    synthetic::write_force_run(runs.back(), made);
  };
  for (const double l0_m : {0.02, 0.01}) {
    made.l0_m = l0_m;
    add();
  }
  EXPECT_TRUE(method_groups(analyse(runs), runs_a_panel).empty()) << "WCSPH alone";
  made.solver = "mps";
  made.walls = "dummies";
  add();
  made.l0_m = 0.02;
  made.parameters = {{"block_distance_m", 0.45}};
  add();
  EXPECT_EQ(method_groups(analyse(runs), runs_a_panel).size(), 1U) << "the block stands elsewhere";
  made.parameters = {};
  add();
  const ReportData data = analyse(runs);
  const fs::path out = fresh("force_methods_out");
  const auto pictures = method_figures({data, out}, SensorKind::force);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_NE(pictures[0].caption.find("the paper's figure 12"), std::string::npos) << pictures[0].caption;
  const std::string script = read(out / "figures/methods_F_block.gp");
  for (const char* title : {"l0 = 20 mm, MPS and WCSPH", "l0 = 10 mm, MPS and WCSPH"})
    EXPECT_NE(script.find(title), std::string::npos) << title;
}

TEST(ForceReport, LeavesOutWhatTheCaseHasNot) {
  const fs::path run = fresh("force_whole_run");
  const fs::path other = fresh("force_whole_other");
  const fs::path out = fresh("force_whole_out");
  MadeForceRun made;
  synthetic::write_force_run(run, made);
  made.alpha = 0.1;
  synthetic::write_force_run(other, made);
  write_report({run, other}, out);
  const std::string page = read(out / "report.md");
  for (const char* absent : {"## Pressure", "## Wave", "Table 2", "FreSCo", "## The paper's statements"})
    EXPECT_EQ(page.find(absent), std::string::npos) << absent;
  for (const char* present :
       {"## Forces", "## Velocities", "## Geometry", "Assumptions of the case", "The gate is a plate", "## Acceptance",
        "0.26 s were added to the measured times", "## Artificial viscosity"})
    EXPECT_NE(page.find(present), std::string::npos) << present;
  for (const char* file :
       {"force_F_column.svg", "force_F_column_raw.svg", "force_impact_F_column.svg", "force_routes_F_column.svg",
        "force_alpha_F_column.svg", "velocity_U.svg", "initial_geometry.svg"})
    EXPECT_TRUE(fs::exists(out / "figures" / file)) << file;
  EXPECT_TRUE(fs::exists(out / "tables/parameters.csv")) << "no table of a paper";
}

TEST(ForceReport, OfTheUnmeasuredCaseSaysSoAndNumbersThePapersTableAndFigures) {
  const fs::path run = fresh("force_aureli_run");
  const fs::path out = fresh("force_aureli_out");
  MadeForceRun made;
  made.case_name = "aureli";
  made.l0_m = 0.02;
  synthetic::write_force_run(run, made);
  synthetic::write_snapshots(run, {0.3, 0.6}, 0.04, "aureli");
  const fs::path as_in_paper = fresh("force_aureli_as_in_paper");
  made.alpha = 0.001;
  made.l0_m = 0.0025;
  synthetic::write_force_run(as_in_paper, made);
  synthetic::write_snapshots(as_in_paper, {0.3}, 0.04, "aureli");
  write_report({run, as_in_paper}, out);
  const std::string page = read(out / "report.md");
  EXPECT_NE(page.find("(the paper's figure 12)"), std::string::npos);
  EXPECT_NE(
      page.find("particles at t = 0.30, 0.60 s (after the paper's figure 11, which has WCSPH at α = 0.001 and l0 = "
                "2.5 mm)"),
      std::string::npos);
  EXPECT_NE(page.find("particles at t = 0.30 s (the paper's figure 11)"), std::string::npos);
  EXPECT_NE(page.find("The experiment's photographs are not part of the comparison."), std::string::npos);
  EXPECT_TRUE(fs::exists(out / "figures/snapshots_R1.png"));
  EXPECT_NE(page.find("Measured: missing."), std::string::npos);
  EXPECT_NE(page.find("(the paper's figure 10)"), std::string::npos);
  EXPECT_TRUE(fs::exists(out / "tables/table3_parameters.csv"));
}

}  // namespace
}  // namespace sluice
