#include "validation/acceptance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// One sensor, window 0..1 s; the rows of each test are filled in.
std::string case_text(const std::string& rows) {
  return R"(name = "pulse"
title = "A pulse"
reference = "none"
gravity_m_s2 = [0.0, 0.0, -9.81]
density_kg_m3 = 1000.0
water_height_m = 0.5
t_end_s = 1.0
window_s = [0.0, 1.0]
output_rate_Hz = 1000
snapshot_times_s = []
measured = "digest.csv"
sensors = [
  { name = "P1", kind = "pressure", position_m = [0.0, 0.5, 0.1], normal = [1, 0, 0], measured = "P1" },
]
tiers = [ { name = "quick", l0_m = 0.05, t_end_s = 1.0 } ]
geometry.tank = { lower_m = [0.0, 0.0, 0.0], upper_m = [3.0, 1.0, 1.0] }
geometry.fluid = [ { lower_m = [2.0, 0.0, 0.0], upper_m = [3.0, 1.0, 0.5] } ]
[[solvers]]
name = "wcsph"
default_walls = "extrapolated"
parameters = { alpha = 0.01 }
walls = [
  { name = "extrapolated", layers = 3, pressure_model = "wall", wave_height_model = "column" },
  { name = "dynamic", layers = 1, pressure_model = "kernel", wave_height_model = "column" },
]
[[acceptance]]
solver = "wcsph"
walls = "extrapolated"
alpha = 0.01
l0_m = [0.02, 0.03]
rows = [
)" + rows +
         "]\n";
}

// A triangle of height 1000 Pa over 0.2 .. 0.6 s.
double pulse(double t_s) {
  return std::max(0.0, 1000 * (1 - std::abs(t_s - 0.4) / 0.2));
}

class AcceptanceTest : public testing::Test {
 protected:
  AcceptanceTest() {
    directory = fs::temp_directory_path() /
                (std::string("sluice-acceptance-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory);
    fs::create_directories(directory);
    write_digest();
    write_run(1.0, 0.0);
  }
  ~AcceptanceTest() override { fs::remove_all(directory); }

  void write_digest() const {
    std::ofstream out(directory / "digest.csv");
    out << "t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa\n";
    for (int k = 0; k < 200; ++k) {
      const double t = 0.005 * k + 0.0025;
      const double low = std::min(pulse(t - 0.0025), pulse(t + 0.0025));
      out << fmt::format("{:.4f},{},{},{}\n", t, pulse(t), low, std::max(pulse(t - 0.0025), pulse(t + 0.0025)));
    }
  }

  // The measured pulse, scaled, and late by a lag.
  void write_run(double scale, double lag_s, double end_s = 1.0) {
    std::ofstream out(directory / "probes.csv");
    out << "t_s,P1_Pa,P1_wall_Pa\n";
    for (int k = 0; k <= static_cast<int>(1000 * end_s); ++k) {
      const double value = scale * pulse(1e-3 * k - lag_s);
      out << fmt::format("{:.3f},{},{}\n", 1e-3 * k, value, value);
    }
  }

  RunRecord record(const nlohmann::json& changes = nlohmann::json::object()) const {
    nlohmann::json manifest{{"schema", 1},  {"case", "pulse"}, {"solver", "wcsph"},   {"walls", "extrapolated"},
                            {"l0_m", 0.03}, {"alpha", 0.01},   {"status", "finished"}};
    manifest["lost"] = {{"through_walls", 0}, {"over_top", 5}};
    manifest["particles"] = {{"fluid", 1000}};
    manifest["fluid_volume"] = {{"deviation", -0.02}};
    manifest.merge_patch(changes);
    std::ofstream(directory / "run.json") << manifest;
    return read_run(directory);
  }

  AcceptanceCheck check(const std::string& row, const nlohmann::json& changes = nlohmann::json::object(),
                        const std::string& sensor_keys = "") const {
    std::string text = case_text("  { " + row + " },\n");
    const std::string end = R"(measured = "P1")";
    text.insert(text.find(end) + end.size(), sensor_keys);
    Case c = parse_case(text, "pulse.toml");
    c.measured = directory / c.measured;
    return check_acceptance(c, record(changes), Measurements::load(c)).at(0);
  }

  fs::path directory;
};

TEST_F(AcceptanceTest, ImpulseOfAScaledPulseDeviatesByTheScale) {
  write_run(1.05, 0);
  const std::string row = R"(metric = "impulse_deviation", sensor = "P1", within = )";
  EXPECT_NEAR(check(row + "0.06").value.value(), 0.05, 1e-3);
  EXPECT_EQ(check(row + "0.06").verdict, AcceptanceVerdict::pass);
  EXPECT_EQ(check(row + "0.04").verdict, AcceptanceVerdict::fail);
}

TEST_F(AcceptanceTest, BandsOfTheirOwnSpeakOfSolversThatTheCaseDoesNotKnow) {
  Case c = parse_case(case_text(R"(  { metric = "lost_through_walls", upper = 0.0 },)"), "pulse.toml");
  c.acceptance.clear();
  c.measured = directory / c.measured;
  const fs::path bands = directory / "bands.toml";
  std::ofstream(bands) << R"([[acceptance]]
solver = "mycode"
rows = [ { metric = "impulse_deviation", sensor = "P1", within = 0.1 } ]
[[acceptance]]
solver = "mycode"
walls = "ghosts"
alpha = 0.02
l0_m = [0.01, 0.02]
rows = [ { metric = "peak_deviation", sensor = "P1", within = 0.1 } ]
)";
  add_bands(c, bands);
  const auto checks = check_acceptance(c, record({{"solver", "mycode"}, {"walls", ""}}), Measurements::load(c));
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].verdict, AcceptanceVerdict::pass) << "any walls, alpha and l0";
  EXPECT_EQ(checks[0].row.file, bands.string());
  EXPECT_EQ(checks[0].row.line, 3);
  EXPECT_EQ(checks[1].verdict, AcceptanceVerdict::not_applicable);
  const auto ghosts = record({{"solver", "mycode"}, {"walls", "ghosts"}, {"alpha", 0.02}, {"l0_m", 0.02}});
  EXPECT_EQ(check_acceptance(c, ghosts, Measurements::load(c)).at(1).verdict, AcceptanceVerdict::pass);
  EXPECT_EQ(check_acceptance(c, record(), Measurements::load(c)).at(0).verdict, AcceptanceVerdict::not_applicable);
}

TEST_F(AcceptanceTest, ArrivalOfALatePulseDiffersByTheLag) {
  write_run(1.0, 0.03);
  const std::string row = R"(metric = "arrival_difference_s", sensor = "P1", model = "wall", within = )";
  EXPECT_NEAR(check(row + "0.035").value.value(), 0.03, 2e-3);
  EXPECT_EQ(check(row + "0.035").verdict, AcceptanceVerdict::pass);
  EXPECT_EQ(check(row + "0.020").verdict, AcceptanceVerdict::fail);
}

TEST_F(AcceptanceTest, TimeOfHalfThePeakIsThatOfTheMeasuredPeakInBoth) {
  write_run(2.0, 0.03);  // half of the measured peak is a quarter of its own: 0.25 of 0.2 s after the start, not 0.5
  const std::string row = R"(metric = "half_peak_time_difference_s", sensor = "P1", within = 0.03)";
  EXPECT_NEAR(check(row).value.value(), 0.03 - 0.05, 2e-3);
}

TEST_F(AcceptanceTest, ARowsOwnWindowIsTheOneItIsEvaluatedOver) {
  const std::string row = R"(metric = "impulse_deviation", sensor = "P1", within = 0.1)";
  write_run(1.0, 0.1);
  EXPECT_NEAR(check(row).value.value(), 0, 1e-3) << "late, but within the case's window";
  const AcceptanceCheck early = check(row + ", window_s = [0.0, 0.4]");
  EXPECT_NEAR(early.value.value(), -0.75, 0.01) << "the half of the rise";
  EXPECT_THAT(acceptance_name(early.row), HasSubstr("P1 0 .. 0.4 s"));
  write_run(1.0, 0, 0.5);
  EXPECT_EQ(check(row + ", window_s = [0.0, 0.4]").verdict, AcceptanceVerdict::pass) << "the run reaches its end";
  EXPECT_EQ(check(row).verdict, AcceptanceVerdict::missing);
}

TEST_F(AcceptanceTest, ASensorsOwnWindowAndShiftCount) {
  write_run(1.0, 0.1, 0.9);
  const std::string row = R"(metric = "rmse_over_range", sensor = "P1", upper = 0.02)";
  EXPECT_EQ(check(row, nlohmann::json::object(), ", window_s = [0.1, 0.9]").verdict, AcceptanceVerdict::fail);
  EXPECT_EQ(check(row, nlohmann::json::object(), ", window_s = [0.1, 0.9], measured_shift_s = 0.1").verdict,
            AcceptanceVerdict::pass);
}

TEST_F(AcceptanceTest, TheShareInsideABandNeedsARealBand) {
  const std::string row = R"(metric = "share_inside_band", sensor = "P1", lower = 0.9)";
  EXPECT_GT(check(row, nlohmann::json::object(), ", measured_is_band = true").value.value(), 0.99);
  EXPECT_THROW(check(row), CaseError) << "the spread in the bins of one recording is none";
}

TEST_F(AcceptanceTest, PeaksKeepTheirSign) {
  write_run(0.7, 0);
  EXPECT_NEAR(check(R"(metric = "peak_deviation", sensor = "P1", within = 0.1)").value.value(), -0.3, 0.01);
  EXPECT_EQ(check(R"(metric = "peak_deviation", sensor = "P1", lower = -0.4, upper = 0.0)").verdict,
            AcceptanceVerdict::pass);
}

TEST_F(AcceptanceTest, RmseOfTheSameCurveIsSmall) {
  EXPECT_EQ(check(R"(metric = "rmse_over_range", sensor = "P1", upper = 0.01)").verdict, AcceptanceVerdict::pass);
  write_run(0.0, 0);
  EXPECT_EQ(check(R"(metric = "rmse_over_range", sensor = "P1", upper = 0.10)").verdict, AcceptanceVerdict::fail);
}

TEST_F(AcceptanceTest, BoundsAreInclusive) {
  EXPECT_EQ(check(R"(metric = "lost_through_walls", upper = 0)").verdict, AcceptanceVerdict::pass);
  EXPECT_EQ(check(R"(metric = "fluid_volume_deviation", within = 0.02)").verdict, AcceptanceVerdict::pass);
}

TEST_F(AcceptanceTest, WholeRunQuantitiesComeFromTheManifest) {
  EXPECT_EQ(check(R"(metric = "lost_over_top_share", upper = 1)").value, 0.005);
  const nlohmann::json leaky{{"lost", {{"through_walls", 1}}}};
  EXPECT_EQ(check(R"(metric = "lost_through_walls", upper = 0)", leaky).verdict, AcceptanceVerdict::fail);
}

TEST_F(AcceptanceTest, TheDensestParticleIsHeldAgainstItsBound) {
  const std::string row = R"(metric = "number_density_max_over_n0", upper = 1.4)";
  EXPECT_EQ(check(row).verdict, AcceptanceVerdict::missing) << "a solver that does not tell it";
  const auto with = [](double n) { return nlohmann::json{{"facts", {{"number_density_max_over_n0", n}}}}; };
  EXPECT_EQ(check(row, with(1.35)).verdict, AcceptanceVerdict::pass);
  const AcceptanceCheck crowded = check(row, with(1.8));
  EXPECT_EQ(crowded.verdict, AcceptanceVerdict::fail);
  EXPECT_EQ(acceptance_value_text(crowded.row, *crowded.value), "1.80 n0");
}

TEST_F(AcceptanceTest, RowsSpeakOnlyOfTheirRuns) {
  const std::string row = R"(metric = "lost_through_walls", upper = 0)";
  EXPECT_EQ(check(row, {{"walls", "dynamic"}}).verdict, AcceptanceVerdict::not_applicable);
  EXPECT_EQ(check(row, {{"solver", "mps"}}).verdict, AcceptanceVerdict::not_applicable);
  EXPECT_EQ(check(row, {{"alpha", 0.1}}).verdict, AcceptanceVerdict::not_applicable);
  EXPECT_EQ(check(row, {{"alpha", nullptr}}).verdict, AcceptanceVerdict::not_applicable);
  EXPECT_EQ(check(row, {{"l0_m", 0.035}}).verdict, AcceptanceVerdict::not_applicable);
  EXPECT_EQ(check(row, {{"l0_m", 0.02}}).verdict, AcceptanceVerdict::pass);
}

TEST_F(AcceptanceTest, WhatIsMissingDoesNotPass) {
  const std::string kernel = R"(metric = "impulse_deviation", sensor = "P1", model = "kernel", within = 0.1)";
  EXPECT_EQ(check(kernel).verdict, AcceptanceVerdict::missing);
  EXPECT_THAT(check(kernel).reason, HasSubstr("P1_kernel_Pa"));
  const nlohmann::json silent{{"lost", nullptr}};
  EXPECT_EQ(check(R"(metric = "lost_through_walls", upper = 0)", silent).verdict, AcceptanceVerdict::missing);
  const Case c = parse_case(case_text(R"(  { metric = "peak_deviation", sensor = "P1", within = 9 },)"), "pulse.toml");
  const auto checks = check_acceptance(c, record(), Measurements::load(c));
  EXPECT_EQ(checks.at(0).verdict, AcceptanceVerdict::missing);
  EXPECT_FALSE(all_passed(checks));
}

TEST_F(AcceptanceTest, ARunThatStoppedEarlyDoesNotPass) {
  const std::string row = R"(metric = "lost_through_walls", upper = 0)";
  EXPECT_EQ(check(row, {{"status", "interrupted"}}).verdict, AcceptanceVerdict::missing);
  EXPECT_EQ(check(row, {{"status", "failed"}}).verdict, AcceptanceVerdict::missing);
  write_run(1.0, 0, 0.5);
  EXPECT_EQ(check(row).verdict, AcceptanceVerdict::missing);
  EXPECT_THAT(check(row).reason, HasSubstr("covers 0.50 s of a window that ends at 1.00 s"));
}

TEST_F(AcceptanceTest, AllPassedNeedsAtLeastOneRow) {
  const AcceptanceCheck pass = check(R"(metric = "lost_through_walls", upper = 0)");
  const AcceptanceCheck fail = check(R"(metric = "fluid_volume_deviation", within = 0.01)");
  const AcceptanceCheck other = check(R"(metric = "lost_through_walls", upper = 0)", {{"walls", "dynamic"}});
  EXPECT_TRUE(all_passed({pass, other}));
  EXPECT_FALSE(all_passed({pass, fail}));
  EXPECT_FALSE(all_passed({other}));
  EXPECT_FALSE(all_passed({}));
}

TEST_F(AcceptanceTest, TheTableShowsValueBandAndVerdict) {
  write_run(1.05, 0);
  const std::string table =
      acceptance_table({check(R"(metric = "impulse_deviation", sensor = "P1", model = "wall", within = 0.04)"),
                        check(R"(metric = "lost_through_walls", upper = 0)", {{"walls", "dynamic"}})});
  EXPECT_THAT(table, HasSubstr("impulse_deviation P1 wall"));
  EXPECT_THAT(table, HasSubstr("+5.0 %"));
  EXPECT_THAT(table, HasSubstr("-4.0 % to +4.0 %"));
  EXPECT_THAT(table, HasSubstr("FAIL"));
  EXPECT_THAT(table, Not(HasSubstr("lost_through_walls")));
}

// Every metric that a case file can name has an evaluation.
TEST(AcceptanceMetrics, AreAllEvaluated) {
  for (const AcceptanceMetric& metric : acceptance_metrics()) {
    if (metric.needs_sensor)
      EXPECT_NO_THROW(sensor_metric(metric.name, Comparison{})) << metric.name;
    else
      EXPECT_NO_THROW(run_metric(metric.name, RunRecord{})) << metric.name;
  }
  EXPECT_THROW(sensor_metric("no_such", Comparison{}), std::invalid_argument);
  EXPECT_THROW(run_metric("no_such", RunRecord{}), std::invalid_argument);
}

// External codes give three lines; everything else is missing, and says so.
TEST_F(AcceptanceTest, ThreeLinesSufficeForAnotherCode) {
  std::ofstream(directory / "run.json") << R"({"case": "pulse", "solver": "interFoam", "l0_m": 0.02})";
  const RunRecord run = read_run(directory);
  EXPECT_FALSE(run.own);
  EXPECT_EQ(run.label(), "interFoam, l0 = 0.02 m");
  EXPECT_EQ(run.alpha(), std::nullopt);
  EXPECT_EQ(run.number("particles.fluid"), std::nullopt);
  EXPECT_TRUE(run.probes.has("P1_Pa"));
}

TEST_F(AcceptanceTest, BrokenRunDirectoriesAreNamed) {
  const auto error = [&](const std::string& manifest) -> std::string {
    std::ofstream(directory / "run.json") << manifest;
    try {
      read_run(directory);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error("{\"case\": "), HasSubstr("run.json: is not valid JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(error(R"({"case": "pulse", "l0_m": 0.02})"), HasSubstr("solver: is missing"));
  EXPECT_THAT(error(R"({"case": "pulse", "solver": "x", "l0_m": "2 cm"})"),
              HasSubstr("l0_m: is missing or of the wrong type"));
  EXPECT_THROW(read_run(directory / "nowhere"), std::runtime_error);
}

TEST(Measurements, ASeriesInAnotherUnitIsLeftOutAndTold) {
  Case c = load_case("kleefsman");
  const auto sensor = std::find_if(c.sensors.begin(), c.sensors.end(), [](const auto& s) { return s.name == "P1"; });
  ASSERT_NE(sensor, c.sensors.end());
  ASSERT_NE(Measurements::load(c).find("P1"), nullptr);
  sensor->kind = SensorKind::wave_height;
  const Measurements measured = Measurements::load(c);
  EXPECT_EQ(measured.find("P1"), nullptr);
  ASSERT_EQ(measured.problems().size(), 1U);
  EXPECT_THAT(measured.problems().front(), AllOf(HasSubstr("is in Pa, sensor P1 in m"), HasSubstr("digest")));
}

}  // namespace
}  // namespace sluice
