// A case whose measurement a user has to supply: without it, and with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "reports/figures.h"
#include "reports/report.h"
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

/// A working directory with a user's file in it, as in a clone.
class UsersMeasurement : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    folder_ = fresh("force_user");
    fs::create_directories(folder_ / "data");
    fs::copy(resolve_in_source_tree("data/aureli2015"), folder_ / "data/aureli2015", fs::copy_options::recursive);
    fs::remove(folder_ / "data/aureli2015/digest.csv");
    fs::current_path(folder_);
  }
  void TearDown() override { fs::current_path(before_); }

  /// A triangle of 10 N around 0.6 s, in the form that the data's README states.
  static void supply() {
    fs::create_directories("raw/aureli2015");
    std::ofstream out("raw/aureli2015/force.csv");
    out << "t_s,F_N\n";
    for (int k = 0; k <= 600; ++k) {
      const double t = 0.005 * k;
      out << t << ',' << std::max(0.0, 10 * (1 - std::abs(t - 0.6) / 0.1)) << '\n';
    }
    out.close();
    EXPECT_EQ(make_digests("data/aureli2015", "raw").front(), "data/aureli2015/digest.csv");
  }

  static MadeForceRun made(double l0_m, double alpha, double scale) {
    MadeForceRun run;
    run.case_name = "aureli";
    run.l0_m = l0_m;
    run.alpha = alpha;
    run.scale = scale;
    return run;
  }

  fs::path before_;
  fs::path folder_;
};

TEST_F(UsersMeasurement, IsMissingUntilAFileOfTheStatedFormIsThere) {
  MadeForceRun run;
  run.case_name = "aureli";
  run.l0_m = 0.02;
  run.scale = 1.2;
  synthetic::write_force_run("run", run);
  ReportData data = analyse({"run"});
  EXPECT_EQ(data.measured_series("F_block"), nullptr);
  EXPECT_EQ(data.measured_remark("F_block"), "Measured: missing.");
  ASSERT_EQ(data.measured.problems().size(), 1u);
  EXPECT_NE(data.measured.problems()[0].find("data/aureli2015/README.md"), std::string::npos);
  EXPECT_EQ(cell(force_peaks_table(data), "Experiment", "peak_N").text, "missing");
  EXPECT_EQ(cell(force_peaks_table(data), "R1", "peak_deviation_percent").text, "missing");

  supply();
  data = analyse({"run"});
  EXPECT_TRUE(data.measured.problems().empty());
  EXPECT_NEAR(*cell(force_peaks_table(data), "Experiment", "peak_N").value, 10, 1e-9);
  EXPECT_NEAR(*cell(force_peaks_table(data), "R1", "peak_deviation_percent", "acceleration").value, 20, 1);
  EXPECT_NEAR(*cell(force_impulses_table(data, "F_block"), "R1", "impulse_0_3_s_deviation_percent").value, 20, 0.5);
  EXPECT_EQ(cell(force_impulses_table(data, "F_block"), "R1", "inside_band_percent").text, not_applicable().text);
}

TEST_F(UsersMeasurement, TellsWhichAlphaIsBestOnlyWhereTheStatedOneWasComputed) {
  supply();
  const auto verdict = [](std::vector<MadeForceRun> runs) {
    std::vector<fs::path> directories;
    for (const MadeForceRun& run : runs) {
      directories.push_back("alpha" + std::to_string(directories.size()));
      synthetic::write_force_run(directories.back(), run);
    }
    return cell(conclusions_table(analyse(directories)), "α = 0.1 gives the best force", "verdict").text;
  };
  EXPECT_EQ(verdict({made(0.02, 0.1, 1.05), made(0.02, 0.01, 1.3)}), "agrees");
  EXPECT_EQ(verdict({made(0.02, 0.1, 1.3), made(0.02, 0.01, 1.05)}), "does not agree");
  EXPECT_EQ(verdict({made(0.02, 0.01, 1.3), made(0.02, 0.001, 1.05)}), "missing") << "0.1 was not computed";
}

TEST_F(UsersMeasurement, WithoutItAnAlphaFigureOfDeviationsIsLeftOut) {
  std::vector<fs::path> directories;
  for (const double alpha : {0.1, 0.01}) {
    directories.push_back("figure" + std::to_string(directories.size()));
    synthetic::write_force_run(directories.back(), made(0.02, alpha, 1.0));
  }
  const ReportData data = analyse(directories);
  EXPECT_TRUE(alpha_figures({data, fresh("force_alpha_figure")}).empty());
  supply();
  const ReportData measured = analyse(directories);
  EXPECT_EQ(alpha_figures({measured, fresh("force_alpha_figure")}).size(), measured.headline_sensors().size());
}

// One recording says nothing of how it would repeat, however its bins were filled.
TEST_F(UsersMeasurement, HasNoUncertaintyOfItsOwn) {
  supply();
  std::vector<fs::path> directories;
  for (const double l0_m : {0.02, 0.0125, 0.01}) {
    directories.push_back("l0_" + std::to_string(directories.size()));
    synthetic::write_force_run(directories.back(), made(l0_m, 0.1, 1 + 10 * l0_m));
  }
  const Table table = validation_uncertainty_table(analyse(directories));
  EXPECT_EQ(cell(table, "F_block impulse", "u_D").text, "missing");
  EXPECT_TRUE(cell(table, "F_block impulse", "error").value);
}

}  // namespace
}  // namespace sluice
