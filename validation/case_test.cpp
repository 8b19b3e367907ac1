#include "validation/case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace sluice {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// The smallest complete case. Line numbers matter to the tests below: keep one entry a line.
const std::string small_case = R"(name = "small"
title = "A small tank"
reference = "none"
gravity_m_s2 = [0.0, 0.0, -9.81]
density_kg_m3 = 1000.0
water_height_m = 0.5
t_end_s = 1.0
window_s = [0.0, 1.0]
output_rate_Hz = 1000
snapshot_times_s = [0.5]
measured = "digest.csv"
sensors = [
  { name = "P1", kind = "pressure", position_m = [1.0, 0.5, 0.1], normal = [1, 0, 0], measured = "P1" },
  { name = "H1", kind = "wave_height", position_m = [2.0, 0.5, 0.0], normal = [0, 0, 1] },
]
tiers = [
  { name = "quick", l0_m = 0.05, t_end_s = 1.0 },
]
[geometry]
tank = { lower_m = [0.0, 0.0, 0.0], upper_m = [3.0, 1.0, 1.0] }
fluid = [
  { lower_m = [2.0, 0.0, 0.0], upper_m = [3.0, 1.0, 0.5] },
]
obstacles = [
  { lower_m = [0.8, 0.3, 0.0], upper_m = [1.0, 0.7, 0.2] },
]
[[solvers]]
name = "wcsph"
default_walls = "extrapolated"
walls = [
  { name = "extrapolated", layers = 3, pressure_model = "wall", wave_height_model = "column" },
]
parameters = { alpha = 0.01 }
[[acceptance]]
solver = "wcsph"
l0_m = [0.0, 0.05]
rows = [
  { metric = "impulse_deviation", sensor = "P1", within = 0.1 },
]
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// The message of the error that the small case with one replacement gives, or "" when it is accepted.
std::string error_of(const std::string& from, const std::string& to) {
  try {
    parse_case(with(small_case, from, to), "small.toml");
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Case, ReadsEverySection) {
  const Case c = parse_case(small_case, "small.toml");
  EXPECT_EQ(c.name, "small");
  EXPECT_EQ(c.tank.upper.x, 3.0);
  ASSERT_EQ(c.fluid.size(), 1u);
  EXPECT_EQ(c.fluid[0].upper.z, 0.5);
  ASSERT_EQ(c.obstacles.size(), 1u);
  ASSERT_NE(c.find_sensor("P1"), nullptr);
  EXPECT_EQ(c.find_sensor("P1")->position_m.z, 0.1);
  EXPECT_EQ(c.find_sensor("H1")->measured, "");
  EXPECT_EQ(c.find_sensor("P9"), nullptr);
  EXPECT_EQ(c.find_tier("quick")->l0_m, 0.05);
  EXPECT_EQ(c.find_solver("wcsph")->parameters.at("alpha"), 0.01);
  ASSERT_EQ(c.acceptance.size(), 1u);
  EXPECT_EQ(c.acceptance[0].lower, -0.1);
  EXPECT_EQ(c.acceptance[0].upper, 0.1);
  EXPECT_EQ(c.acceptance[0].l0_max_m, 0.05);
  EXPECT_FALSE(c.acceptance[0].alpha.has_value());
}

TEST(Case, UnknownKeysNameFileLineAndKeyAndTheLikelyOne) {
  EXPECT_EQ(error_of("title", "titel"), "small.toml:1: title: is missing (add `title = ...`, a string)");
  EXPECT_THAT(error_of("reference = \"none\"", "reference = \"none\"\nwindows_s = [0, 1]"),
              AllOf(StartsWith("small.toml:4: windows_s: unknown key"), HasSubstr("`window_s`")));
  EXPECT_THAT(error_of("layers = 3", "layers = 3, thickness = 2"),
              StartsWith("small.toml:31: solvers[0].walls[0].thickness: unknown key"));
  EXPECT_THAT(error_of("[geometry]", "[geometry]\ngates = []"),
              StartsWith("small.toml:20: geometry.gates: unknown key"));
}

TEST(Case, SolverParametersMustBeKnownToTheSolver) {
  EXPECT_EQ(error_of("alpha = 0.01", "alfa = 0.01"),
            "small.toml:33: solvers[0].parameters.alfa: unknown parameter of solver wcsph (did you mean `alpha`?)");
  EXPECT_EQ(error_of("layers = 3", "layers = 3, parameters = { delto = 0.1 }"),
            "small.toml:31: solvers[0].walls[0].parameters.delto: unknown parameter of solver wcsph (did you mean "
            "`delta`?)");
}

TEST(Case, WrongTypesNameTheirLine) {
  EXPECT_EQ(error_of("density_kg_m3 = 1000.0", "density_kg_m3 = \"1000\""),
            "small.toml:5: density_kg_m3: is a string, must be a number");
  EXPECT_EQ(error_of("[0.0, 0.0, -9.81]", "-9.81"),
            "small.toml:4: gravity_m_s2: is a number, must be an array of numbers");
  EXPECT_EQ(error_of("[0.0, 0.0, -9.81]", "[0.0, -9.81]"),
            "small.toml:4: gravity_m_s2: has 2 numbers, must have three: [x, y, z]");
  EXPECT_THAT(error_of("layers = 3", "layers = 2.5"), HasSubstr("layers: is a number, must be an integer"));
  EXPECT_THAT(error_of("name = \"small\"", "name = 3"),
              StartsWith("small.toml:1: name: is an integer, must be a string"));
  EXPECT_THAT(error_of("alpha = 0.01", "alpha = true"), HasSubstr("parameters.alpha: is a truth value"));
}

TEST(Case, HostileTextsGetAMessage) {
  EXPECT_EQ(error_of("layers = 3", "layers = 9999999999"),
            "small.toml:31: solvers[0].walls[0].layers: is 9999999999, too large");
  std::string deep = "a";
  for (int k = 0; k < 100'000; ++k) deep += ".a";
  EXPECT_EQ(error_of("name = \"small\"\n", "name = \"small\"\n" + deep + " = 1\n"),
            "small.toml:2: syntax: a key of more than 20 parts");
  EXPECT_EQ(error_of("\"none\"", "\"" + std::string(100, '.') + "\"  # " + std::string(100, '.')), "");
  EXPECT_EQ(error_of("\"none\"", "'''\n\"" + std::string(100, '.') + "'''"), "");
  const std::string odd = error_of("reference = ", "\"a\\u001b[2J\" = 1\nreference = ");
  EXPECT_THAT(odd, StartsWith("small.toml:3: a\\x1b[2J: unknown key"));
  EXPECT_LT(error_of("title", std::string(100'000, 'x')).size(), 2000u);
}

// The small case with a gate, a named block, and sensors of force and velocity; `change` replaces one piece of it.
std::string case_with_forces(const std::string& from = "", const std::string& to = "") {
  std::string text = with(small_case, "  { lower_m = [0.8, 0.3, 0.0], upper_m = [1.0, 0.7, 0.2] },\n",
                          "  { name = \"block\", lower_m = [0.8, 0.3, 0.0], upper_m = [1.0, 0.7, 0.2] },\n"
                          "  { name = \"gate\", lower_m = [1.98, 0.0, 0.0], upper_m = [2.0, 1.0, 1.0], thin = true, "
                          "velocity_m_s = [0, 0, 1.5], start_s = 0.1 },\n");
  text = with(text, "  { name = \"H1\"",
              "  { name = \"F_block\", kind = \"force\", body = \"block\", face = \"x+\", direction = [-1, 0, 0] },\n"
              "  { name = \"U\", kind = \"velocity\", position_m = [1.5, 0.5, 0.1], direction = [1, 0, 0] },\n"
              "  { name = \"H1\"");
  text = with(text, "wave_height_model = \"column\"", "wave_height_model = \"column\", force_model = \"acceleration\"");
  return from.empty() ? text : with(text, from, to);
}

std::string force_error_of(const std::string& from, const std::string& to) {
  try {
    parse_case(case_with_forces(from, to), "small.toml");
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Case, ReadsForcesVelocitiesAndBodiesThatMove) {
  const Case c = parse_case(case_with_forces(), "small.toml");
  ASSERT_EQ(c.obstacles.size(), 2u);
  EXPECT_TRUE(c.obstacles[1].thin);
  EXPECT_TRUE(c.obstacles[1].motion.moves());
  EXPECT_FALSE(c.obstacles[0].motion.moves());
  EXPECT_DOUBLE_EQ(c.obstacles[1].motion.displacement_m(0.3).z, 0.3);
  const CaseSensor& force = *c.find_sensor("F_block");
  EXPECT_EQ(force.body, "block");
  EXPECT_EQ(force.face.axis, 0);
  EXPECT_TRUE(force.face.upwards);
  EXPECT_EQ(probe_column(force, "pressure"), "F_block_pressure_N");
  EXPECT_EQ(probe_column(*c.find_sensor("U")), "U_m_s");
  EXPECT_EQ(primary_model(c, force, "wcsph", "extrapolated"), "acceleration");
}

TEST(Case, ForcesAndMotionsThatMakeNoSenseAreRefused) {
  EXPECT_THAT(force_error_of("body = \"block\"", "body = \"blok\""),
              AllOf(HasSubstr("sensors[1].body: unknown value `blok`"), HasSubstr("`block`")));
  EXPECT_THAT(force_error_of("face = \"x+\"", "face = \"x\""), HasSubstr("face: unknown value `x`"));
  EXPECT_THAT(force_error_of("direction = [-1, 0, 0]", "direction = [-2, 0, 0]"), HasSubstr("must be a unit vector"));
  EXPECT_THAT(force_error_of(", force_model = \"acceleration\"", ""), HasSubstr("force_model: is missing"));
  EXPECT_THAT(force_error_of("[0, 0, 1.5]", "[1, 0, 0]"), HasSubstr("give stop_s"));
  EXPECT_THAT(force_error_of("start_s = 0.1", "start_s = 0.1, stop_s = 0.1"), HasSubstr("stop_s: must come after"));
  EXPECT_THAT(force_error_of("name = \"gate\"", "name = \"block\""), HasSubstr("`block` occurs twice"));
  EXPECT_THAT(force_error_of("name = \"U\"", "name = \"F\""), HasSubstr("cannot be told from sensor F_block"));
  EXPECT_THAT(force_error_of("[1.98, 0.0, 0.0]", "[0.9, 0.0, 0.0]"), HasSubstr("overlaps another obstacle"));
}

TEST(Case, SyntaxErrorsNameTheirLine) {
  EXPECT_THAT(error_of("reference = \"none\"", "reference = \"none"), StartsWith("small.toml:3: syntax: "));
}

TEST(Case, ValuesThatAreNoNumbersAreRefused) {
  EXPECT_THAT(error_of("water_height_m = 0.5", "water_height_m = nan"),
              AllOf(StartsWith("small.toml:6: water_height_m:"), HasSubstr("not finite")));
  EXPECT_THAT(error_of("upper_m = [3.0, 1.0, 1.0]", "upper_m = [inf, 1.0, 1.0]"), HasSubstr("not finite"));
}

TEST(Case, ImpossibleGeometryIsRefused) {
  EXPECT_THAT(error_of("upper_m = [3.0, 1.0, 1.0]", "upper_m = [3.0, -1.0, 1.0]"),
              AllOf(StartsWith("small.toml:20: geometry.tank.upper_m"), HasSubstr("negative")));
  EXPECT_THAT(error_of("upper_m = [3.0, 1.0, 0.5]", "upper_m = [3.1, 1.0, 0.5]"),
              AllOf(StartsWith("small.toml:22: geometry.fluid[0].upper_m"), HasSubstr("outside of the tank")));
  EXPECT_THAT(error_of("upper_m = [1.0, 0.7, 0.2]", "upper_m = [2.2, 0.7, 0.2]"),
              AllOf(StartsWith("small.toml:25: geometry.obstacles[0]"), HasSubstr("overlaps the fluid")));
  EXPECT_THAT(error_of("water_height_m = 0.5", "water_height_m = 0.55"),
              AllOf(StartsWith("small.toml:6: water_height_m"), HasSubstr("0.5 m high")));
  EXPECT_THAT(error_of("-9.81", "9.81"), AllOf(StartsWith("small.toml:4: gravity_m_s2"), HasSubstr("down the z axis")));
}

TEST(Case, SensorsMustStandInTheTankAndOutsideOfObstacles) {
  EXPECT_THAT(error_of("position_m = [1.0, 0.5, 0.1]", "position_m = [1.0, 1.5, 0.1]"),
              AllOf(StartsWith("small.toml:13: sensors[0].position_m"), HasSubstr("outside of the tank")));
  EXPECT_THAT(error_of("position_m = [1.0, 0.5, 0.1]", "position_m = [0.9, 0.5, 0.1]"),
              HasSubstr("lies inside geometry.obstacles[0]"));
  EXPECT_THAT(error_of("normal = [1, 0, 0]", "normal = [1, 1, 0]"), HasSubstr("unit vector"));
  EXPECT_THAT(error_of("name = \"H1\"", "name = \"P1\""), HasSubstr("occurs twice"));
  EXPECT_THAT(error_of("kind = \"pressure\"", "kind = \"presure\""), HasSubstr("did you mean `pressure`?"));
  EXPECT_THAT(error_of("measured = \"digest.csv\"\n", ""), HasSubstr("sensor P1 has a measured series"));
}

TEST(Case, ParticleDistanceMustResolveTheObstacle) {
  const std::string error = error_of("l0_m = 0.05, t", "l0_m = 0.07, t");
  EXPECT_THAT(error,
              AllOf(StartsWith("small.toml:17: tiers[0].l0_m: is 0.07 m, too large"), HasSubstr("0.0666 m or less")));
  const Case c = parse_case(small_case, "small.toml");
  EXPECT_EQ(particle_distance_problem(c, 0.0666), "");
  EXPECT_NE(particle_distance_problem(c, -0.01), "");
  EXPECT_NE(particle_distance_problem(c, 0.0), "");
}

TEST(Case, AcceptanceRowsMustMakeSense) {
  EXPECT_THAT(error_of("impulse_deviation", "impuls_deviation"),
              AllOf(StartsWith("small.toml:38: acceptance[0].rows[0].metric"), HasSubstr("`impulse_deviation`")));
  EXPECT_THAT(error_of("sensor = \"P1\", within", "sensor = \"P2\", within"), HasSubstr("unknown value `P2`"));
  EXPECT_THAT(error_of("sensor = \"P1\", within", "sensor = \"P1\", model = \"column\", within"),
              HasSubstr("cannot read a pressure sensor"));
  EXPECT_THAT(error_of("sensor = \"P1\", within", "sensor = \"H1\", within"), HasSubstr("no measured series"));
  EXPECT_THAT(error_of("within = 0.1", "within = -0.1"), HasSubstr("greater than zero"));
  EXPECT_THAT(error_of("within = 0.1", "lower = 0.2, upper = 0.1"), HasSubstr("nothing could pass"));
  EXPECT_THAT(error_of(", within = 0.1", ""), HasSubstr("must have either `within`"));
  EXPECT_THAT(error_of("l0_m = [0.0, 0.05]", "l0_m = [0.05, 0.0]"), HasSubstr("exchange them"));
}

TEST(Case, BandsMayBeOneSided) {
  const Case c = parse_case(with(small_case, "within = 0.1", "upper = 0.1"), "small.toml");
  EXPECT_EQ(c.acceptance[0].upper, 0.1);
  EXPECT_LT(c.acceptance[0].lower, -1e300);
}

TEST(Case, ASensorSaysHowItsSeriesWasMeasuredAndWhereItIsCompared) {
  const std::string key = "measured = \"P1\"";
  const Case c =
      parse_case(with(small_case, key,
                      key + R"(, measured_in = "other.csv", measured_shift_s = 0.26, measured_is_band = true)"
                            ", window_s = [0.2, 0.9], impulses_s = [[0.2, 0.5], [0.5, 0.9]]"),
                 "small.toml");
  const CaseSensor& p1 = *c.find_sensor("P1");
  EXPECT_EQ(c.measured_file(p1), "other.csv");
  EXPECT_EQ(c.measured_file(*c.find_sensor("H1")), "") << "nothing measured";
  EXPECT_EQ(p1.measured_shift_s, 0.26);
  EXPECT_TRUE(p1.measured_is_band);
  EXPECT_EQ(c.window_of(p1).start_s, 0.2);
  EXPECT_EQ(c.window_of(*c.find_sensor("H1")).end_s, 1.0);
  ASSERT_EQ(p1.impulses_s.size(), 2u);
  EXPECT_EQ(p1.impulses_s[1].end_s, 0.9);
  EXPECT_THAT(error_of("normal = [0, 0, 1]", "normal = [0, 0, 1], measured_shift_s = 0.2"),
              HasSubstr("small.toml:14: sensors[1].measured_shift_s: says how a series was measured"));
  EXPECT_THAT(error_of(key, key + ", impulses_s = [0.2, 0.5]"), HasSubstr("must be an array of pairs"));
  EXPECT_THAT(error_of(key, key + ", impulses_s = [[0.5, 0.2]]"), HasSubstr("exchange them"));
  EXPECT_THAT(error_of("within = 0.1", "within = 0.1, window_s = [0.3, 0.3]"), HasSubstr("must be a span of time"));
}

TEST(Case, HashFollowsTheBytes) {
  const Case a = parse_case(small_case, "a.toml");
  EXPECT_EQ(a.hash, parse_case(small_case, "b.toml").hash);
  EXPECT_NE(a.hash, parse_case(small_case + "\n", "a.toml").hash);
}

TEST(Case, UnknownNamesListTheKnownOnes) {
  try {
    load_case("kleefsmann");
    FAIL() << "accepted";
  } catch (const CaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean `kleefsman`?"));
  }
  EXPECT_THROW(load_case("no/such/file.toml"), CaseError);
}

TEST(ProbeColumn, JoinsSensorModelAndUnit) {
  const CaseSensor pressure{"P1", SensorKind::pressure, {}, {}, ""};
  const CaseSensor wave{"H1", SensorKind::wave_height, {}, {}, ""};
  EXPECT_EQ(probe_column(pressure), "P1_Pa");
  EXPECT_EQ(probe_column(pressure, "wall"), "P1_wall_Pa");
  EXPECT_EQ(probe_column(wave, "column"), "H1_column_m");
}

}  // namespace
}  // namespace sluice
