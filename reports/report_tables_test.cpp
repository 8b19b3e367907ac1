// Tables of cases with pressures, on runs whose errors are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

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

TEST(ReportTables, KnownScaleAndShiftGiveKnownNumbers) {
  const fs::path dir = fresh("known");
  MadeRun run;
  run.scale = 1.1;
  run.second_scale = 0.7;
  run.shift_s = 0.02;
  synthetic::write_run(dir, run);
  const ReportData data = analyse({dir});
  const Table impulses = impulses_table(data, true);
  // The shift pushes the last 20 ms of the measured curve out of the window.
  const MeasuredSeries& p1 = *data.measured_series("P1");
  const double kept = *impulse(p1, {0, 5.98}) / *impulse(p1, {0, 6});
  EXPECT_NEAR(*cell(impulses, "R1", "P1_percent", "wall (primary)").value, 100 * (1.1 * kept - 1), 0.02);
  EXPECT_NEAR(*cell(impulses, "R1", "P1_percent", "kernel").value, 100 * (0.7 * kept - 1), 0.02);
  const Table paper = paper_impulses_table(data);
  EXPECT_NEAR(*cell(paper, "R1", "P1_unsigned_deviation_percent", "kernel").value, 100 * (1 - 0.7 * kept), 0.02);
  EXPECT_NEAR(*cell(paper, "Experiment", "P1_Pa_s").value, 13391.65, 0.5);
  EXPECT_EQ(cell(paper, "Paper: WCSPH, α = 0.01", "P2_Pa_s").value, 5390);
  const Table metrics = sensor_metrics_table(data, SensorKind::pressure, false);
  EXPECT_NEAR(*cell(metrics, "R1", "best_lag_ms").value, 20, 1);
  EXPECT_NEAR(*cell(metrics, "R1", "arrival_difference_ms").value, 20, 3);
  const Table waves = sensor_metrics_table(data, SensorKind::wave_height, true);
  EXPECT_NEAR(*cell(waves, "R1", "peak_deviation_percent", "column (primary)").value, 10, 1.5);
  EXPECT_NEAR(*cell(waves, "R1", "peak_deviation_percent", "top").value, 21, 1.5);
}

TEST(ReportTables, AnExternalCodeNeedsThreeLinesAndMissingStaysMissing) {
  const fs::path dir = fresh("external");
  synthetic::write_external_run(dir, 0.5);
  const ReportData data = analyse({dir});
  const Table paper = paper_impulses_table(data);
  EXPECT_NEAR(*cell(paper, "R1", "P1_unsigned_deviation_percent", "as delivered").value, 50, 0.3);
  EXPECT_EQ(cell(paper, "R1", "P2_Pa_s").text, "missing");
  const Table parameters = parameters_table(data);
  for (const char* column : {"steps", "wall_time_s", "fluid_particles", "alpha", "peak_memory_bytes"})
    EXPECT_EQ(cell(parameters, "R1", column).text, "missing") << column;
  EXPECT_EQ(cell(provenance_table(data), "R1", "commit").text, "missing");
  EXPECT_EQ(cell(provenance_table(data), "R1", "lost_through_walls").text, "missing") << "never a zero";
}

TEST(ReportTables, SaysWhatTheKernelProbeSaw) {
  const fs::path dir = fresh("support");
  synthetic::write_run(dir, {});
  const ReportData data = analyse({dir});
  EXPECT_EQ(*cell(kernel_support_table(data), "R1", "P1_percent").value, 100) << "support 0.8 throughout";
  const fs::path external = fresh("support_external");
  synthetic::write_external_run(external, 1);
  EXPECT_EQ(cell(kernel_support_table(analyse({external})), "R1", "P1_percent").text, "missing");
}

TEST(ReportTables, LabelsSayWhatARunHasSetOtherwiseThanTheCase) {
  const fs::path dir = fresh("changed");
  synthetic::write_run(dir, {});
  std::ifstream in(dir / "run.json");
  auto manifest = nlohmann::json::parse(in);
  EXPECT_EQ(analyse({dir}).runs[0].label, "R1 WCSPH extrapolated, α = 0.01, l0 20 mm");
  manifest["parameters"] = {{"alpha", 0.01}, {"delta", 0.02}, {"wall_friction", 0.0}, {"courant", 0.2}};
  std::ofstream(dir / "run.json") << manifest;
  EXPECT_EQ(analyse({dir}).runs[0].label, "R1 WCSPH extrapolated, α = 0.01, l0 20 mm, delta = 0.02")
      << "friction 0 is the walls' own default";
}

TEST(ReportTables, UnitsThatCannotBeRightAreDoubted) {
  const fs::path dir = fresh("units");
  synthetic::write_external_run(dir, 1000.0);
  const auto problems = analyse({dir}).runs[0].problems;
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_NE(problems[1].find("P1 peaks at"), std::string::npos) << problems[1];
  EXPECT_NE(problems[1].find("is its unit Pa?"), std::string::npos) << problems[1];
  synthetic::write_external_run(dir, 2.0);
  EXPECT_TRUE(analyse({dir}).runs[0].problems.empty());
  std::ofstream(dir / "probes.csv") << "t_s,P1_Pa\n0,0\n400,5000\n6000,0\n";
  EXPECT_EQ(analyse({dir}).runs[0].problems.back(), "ends at 6000 s, the case at 6.0 s: are its times in s?");
  synthetic::write_external_run(dir, 2.0);
  test_files::put_in_manifest(dir, {{"l0_m", 20}});
  EXPECT_EQ(analyse({dir}).runs[0].problems,
            std::vector<std::string>{"l0_m is 20, more than the fluid is long: is it in m?"});
}

TEST(ReportTables, TheAirsPressureIsToldFromTheWaters) {
  const fs::path dir = fresh("absolute");
  synthetic::write_external_run(dir, 1.0);
  std::ofstream out(dir / "probes.csv");
  out << "t_s,P1_Pa\n";
  for (int k = 0; k <= 6000; ++k) out << 0.001 * k << ',' << (k < 420 ? 101325 : 106325) << '\n';
  out.close();
  const ReportData data = analyse({dir});
  ASSERT_FALSE(data.runs[0].problems.empty());
  EXPECT_TRUE(data.runs[0].problems.back().starts_with("P1 reads 101325 Pa before the wave comes"))
      << data.runs[0].problems.back();
  const std::vector<std::string>& remarks = data.runs[0].primary("P1")->comparison.remarks;
  ASSERT_FALSE(remarks.empty());
  EXPECT_TRUE(remarks.front().ends_with("from the start")) << remarks.front();
}

TEST(ReportTables, EnergyAndCompressionOfTheFluid) {
  const fs::path own = fresh("conservation");
  const fs::path external = fresh("conservation_external");
  synthetic::write_run(own, {});
  synthetic::write_external_run(external, 1.0);
  const Table table = conservation_table(analyse({own, external}));
  EXPECT_NEAR(*cell(table, "R1", "energy_start_J").value, 1000, 1e-9);
  EXPECT_NEAR(*cell(table, "R1", "energy_end_percent").value, 99, 1e-9);
  EXPECT_NEAR(*cell(table, "R1", "energy_rise_percent").value, 1, 1e-9);
  EXPECT_NEAR(*cell(table, "R1", "density_ratio_max_1").value, 1.3, 1e-9);
  EXPECT_NEAR(*cell(table, "R1", "density_ratio_max_later_1").value, 1.01, 1e-9);
  EXPECT_EQ(cell(table, "R2", "energy_start_J").text, "missing");
}

TEST(ReportTables, PairsOfRunsThatDifferInTheirWallsAlone) {
  const fs::path a = fresh("pair_a");
  const fs::path b = fresh("pair_b");
  const fs::path c = fresh("pair_c");
  MadeRun run;
  synthetic::write_run(a, run);
  run.walls = "dynamic";
  run.scale = 0.6;
  synthetic::write_run(b, run);
  run.alpha = 0.1;
  synthetic::write_run(c, run);
  const ReportData data = analyse({c, b, a});
  EXPECT_EQ(data.runs[0].record.walls, "extrapolated") << "the report orders runs itself";
  const Table table = boundary_models_table(data);
  EXPECT_NEAR(*cell(table, "R1", "mean_unsigned_percent").value, 0, 0.1);
  EXPECT_NEAR(*cell(table, "R3", "P2_percent", "dynamic").value, -40, 0.1);
  for (const TableRow& row : table.rows) EXPECT_FALSE(row.cells[0].text.starts_with("R2")) << "α = 0.1 has no partner";
  EXPECT_NEAR(*cell(table, "Paper", "P1_percent").value, -27.5, 0.1);
}

TEST(ReportTables, ThreeResolutionsGiveAnOrderOrTheWordsThatThereIsNone) {
  std::vector<fs::path> dirs;
  MadeRun run;
  for (double l0 : {0.04, 0.02, 0.01}) {
    dirs.push_back(fresh("resolution_" + std::to_string(dirs.size())));
    run.l0_m = l0;
    run.scale = 1 + 100 * l0 * l0;  // second order
    synthetic::write_run(dirs.back(), run);
  }
  const Table table = resolution_table(analyse(dirs));
  const std::string order = cell(table, "P1 impulse", "observed_order").text;
  EXPECT_TRUE(order.starts_with("order 2.0")) << order;
  EXPECT_NEAR(*cell(table, "P1 impulse [%]", "l0_40_mm").value, 16, 0.1);
  EXPECT_NEAR(*cell(table, "P1 impulse, kernel [%]", "l0_40_mm").value, -10, 0.1) << "beside the primary reading";
  run.l0_m = 0.01;
  run.scale = 1.3;  // finer is worse
  synthetic::write_run(dirs.back(), run);
  EXPECT_EQ(cell(resolution_table(analyse(dirs)), "P1 impulse", "observed_order").text, "not in the asymptotic range");
}

TEST(ReportTables, NoOrderWhereTheLatticeChangesTheGeometry) {
  std::vector<fs::path> dirs;
  for (const auto& [l0_m, depth_m] : {std::pair(0.04, 0.56), std::pair(0.02, 0.54), std::pair(0.01, 0.55)}) {
    dirs.push_back(fresh("geometry_" + std::to_string(dirs.size())));
    synthetic::write_run(dirs.back(), {.l0_m = l0_m, .scale = 1 + 100 * l0_m * l0_m});
    test_files::put_in_manifest(
        dirs.back(),
        {{"fitted_lengths", {{{"name", "fluid[0].upper.z"}, {"nominal_m", 0.55}, {"fitted_m", depth_m}}}}});
  }
  const ReportData data = analyse(dirs);
  const Table table = resolution_table(data);
  EXPECT_EQ(cell(table, "P1 impulse", "observed_order").text, "none: geometries differ");
  EXPECT_NE(table.notes.front().find("fluid[0] is 0.560, 0.540, 0.550 m high"), std::string::npos)
      << table.notes.front();
  EXPECT_EQ(cell(validation_uncertainty_table(data), "P1 impulse", "u_num").text, "missing");
  for (const fs::path& dir : dirs)
    test_files::put_in_manifest(dir, {{"fitted_lengths", {1, {{"name", 2}}, {{"name", "x"}, {"fitted_m", nullptr}}}}});
  EXPECT_TRUE(cell(resolution_table(analyse(dirs)), "P1 impulse", "observed_order").text.starts_with("order 2.0"));
}

TEST(ReportTables, NoOrderWhereTheLatticeMovesTheBox) {
  std::vector<fs::path> dirs;
  for (const auto& [l0_m, front_m] : {std::pair(0.04, 0.80), std::pair(0.02, 0.82), std::pair(0.01, 0.82)}) {
    dirs.push_back(fresh("moved_" + std::to_string(dirs.size())));
    synthetic::write_run(dirs.back(), {.l0_m = l0_m, .scale = 1 + 100 * l0_m * l0_m});
    const auto fitted = [](const char* name, double nominal_m, double fitted_m) {
      return nlohmann::json{{"name", name}, {"nominal_m", nominal_m}, {"fitted_m", fitted_m}};
    };
    test_files::put_in_manifest(
        dirs.back(),
        {{"fitted_lengths",
          {fitted("obstacle[0].lower.x", 0.6635, front_m - 0.16), fitted("obstacle[0].upper.x", 0.8245, front_m)}}});
  }
  const Table table = resolution_table(analyse(dirs));
  EXPECT_EQ(cell(table, "P1 impulse", "observed_order").text, "none: geometries differ");
  EXPECT_NE(table.notes.front().find(
                "obstacle[0] is 1.19, 1.17, 1.17 m from fluid[0]; obstacle[0] is 0.640, 0.660, 0.660 m from the wall "
                "behind it"),
            std::string::npos)
      << table.notes.front();
}

TEST(ReportTables, TheFinestRunThatHasAValueStandsBesideItsUncertainty) {
  std::vector<fs::path> dirs;
  for (const double l0_m : {0.04, 0.02, 0.01}) {
    dirs.push_back(fresh("uncertain_" + std::to_string(dirs.size())));
    synthetic::write_run(dirs.back(), {.l0_m = l0_m});
  }
  std::ifstream whole(dirs.back() / "probes.csv");
  std::string with_gap;
  for (std::string line; std::getline(whole, line);)
    if (!line.starts_with("2.")) with_gap += line + '\n';
  whole.close();
  std::ofstream(dirs.back() / "probes.csv") << with_gap;
  const Table table = validation_uncertainty_table(analyse(dirs));
  EXPECT_NE(cell(table, "P1 impulse [Pa s], R2", "error").text, "missing");
}

/// Half of the runs 20 % too high, half as much too low in the logarithm: no bias but that of the scatter itself.
TEST(ReportTables, BiasAndScatterOfEachMethod) {
  std::vector<fs::path> runs;
  MadeRun made;
  for (const double alpha : {0.1, 0.01, 0.001, 0.0001}) {
    runs.push_back(fresh("bias_" + std::to_string(runs.size())));
    made.alpha = alpha;
    made.scale = runs.size() % 2 == 0 ? 1.2 : 1 / 1.2;
    synthetic::write_run(runs.back(), made);
  }
  const Table table = bias_table(analyse(runs));
  const double deviation = std::log(1.2) * std::sqrt(32.0 / 31.0);
  EXPECT_EQ(*cell(table, "WCSPH", "pairs").value, 32);
  EXPECT_NEAR(*cell(table, "WCSPH", "scatter_percent").value, 100 * deviation, 0.05);
  EXPECT_NEAR(*cell(table, "WCSPH", "bias").value, std::exp(0.5 * deviation * deviation), 1e-3);
  const Table best = best_alpha_table(analyse(runs));
  EXPECT_EQ(*cell(best, "P1 impulse", "alpha").value, 0.001) << "16.7 % too low against 20 % too high";
  EXPECT_NEAR(*cell(best, "P1 impulse", "error_percent").value, 100 * (1 - 1 / 1.2), 0.05);
}

TEST(ReportTables, AcceptanceNamesPassFailAndNotApplicable) {
  const fs::path a = fresh("accept_a");
  const fs::path b = fresh("accept_b");
  const fs::path c = fresh("accept_c");
  MadeRun made;
  synthetic::write_run(a, made);
  made.alpha = 0.001;
  synthetic::write_run(b, made);
  made.alpha = 0.01;
  made.l0_m = 0.015;
  made.scale = 1.3;
  synthetic::write_run(c, made);
  const Table table = acceptance_matrix(analyse({a, b, c}));
  EXPECT_NE(cell(table, "impulse deviation P1 wall", "R1").text.find("pass"), std::string::npos);
  EXPECT_EQ(cell(table, "impulse deviation P1 wall", "R2").text, "n/a") << "the row is for α = 0.01";
  EXPECT_NE(cell(table, "impulse deviation P1 wall", "R3").text.find("FAIL"), std::string::npos);
  EXPECT_NEAR(*cell(table, "impulse deviation P1 wall", "R3").value, 0.3, 1e-3);
}

}  // namespace
}  // namespace sluice
