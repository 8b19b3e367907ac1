#include "validation/foreign.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "validation/case.h"
#include "validation/digest.h"
#include "validation/file_hash.h"
#include "validation/foreign_test.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

using foreign_test::ForeignTest;
using foreign_test::mapped;
using foreign_test::plain;

TEST_F(ForeignTest, ColumnsAreFoundByNameAndOthersMayHoldAnything) {
  write("a.csv", "time_s,remark,H2_m,P1_Pa\n0,dry,0.0,5\n0.5,wet,0.1,7.5\n");
  const ProbeTable t = read(plain);
  EXPECT_THAT(t.names(), ElementsAre("P1_Pa", "H2_m"));
  EXPECT_THAT(t.times_s(), ElementsAre(0, 0.5));
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(5, 7.5));
  EXPECT_THAT(t.values("H2_m"), ElementsAre(0, 0.1));
}

TEST_F(ForeignTest, UnitsOffsetsSemicolonsAndDecimalCommas) {
  write("g.csv", " ;PosX [m]:;0,8245\n ;PosZ [m]:;0,021\nPart;Time [ms];Press_0 [kPa]\n0;0,0;101,325\n1;2,5;102,325\n");
  const ProbeTable t = read(R"([[files]]
file = "g.csv"
separator = ";"
decimal_comma = true
header_lines = 3
time = { column = "Time [ms]", unit = "ms", offset_s = 0.1 }
columns = [ { sensor = "P1", column = "Press_0 [kPa]", unit = "kPa", offset = -101.325 } ]
)");
  EXPECT_THAT(t.times_s(), ElementsAre(DoubleEq(0.1), DoubleEq(0.1025)));
  EXPECT_NEAR(t.values("P1_Pa")[0], 0, 1e-9);
  EXPECT_NEAR(t.values("P1_Pa")[1], 1000, 1e-9);
}

/// A file for each gauge of the water level, with the gauge's own place in further columns; pressures of the measuring
/// tool under lines that say where its points are.
TEST_F(ForeignTest, TheFormOfDualSphysicsGauges) {
  const std::string head = "time [s];swlx [m];swly [m];swlz [m];pos0x [m];pos0y [m];pos0z [m]\n";
  write("GaugesSWL_H2.csv", head + "0;0.992;0.5;0;0.992;0.5;0\n0.05;0.992;0.5;0.01;0.992;0.5;0\n");
  write("GaugesSWL_H4.csv", head + "0;2.638;0.5;0.55;2.638;0.5;0\n0.05;2.638;0.5;0.549;2.638;0.5;0\n");
  write("PointsPressure_Press.csv",
        " ;PosX [m]:;0.8245;0.8245\n ;PosY [m]:;0.4745;0.4745\n ;PosZ [m]:;0.021;0.061\n"
        "Part;Time [s];Press_0 [Pa];Press_1 [Pa]\n0;0;0;0\n1;0.05;12.5;-3e-1\n");
  std::string map;
  for (const char* gauge : {"H2", "H4"})
    map += std::string("[[files]]\nfile = \"GaugesSWL_") + gauge +
           ".csv\"\nseparator = \";\"\ntime = { column = \"time [s]\", unit = \"s\" }\ncolumns = [ { sensor = \"" +
           gauge + "\", column = \"swlz [m]\", unit = \"m\" } ]\n";
  const ProbeTable t = read(map + R"([[files]]
file = "PointsPressure_Press.csv"
separator = ";"
header_lines = 4
time = { column = "Time [s]", unit = "s" }
columns = [
  { sensor = "P1", column = "Press_0 [Pa]", unit = "Pa" },
  { sensor = "P2", column = "Press_1 [Pa]", unit = "Pa" },
]
)");
  EXPECT_THAT(t.names(), ElementsAre("H2_m", "H4_m", "P1_Pa", "P2_Pa"));
  EXPECT_THAT(t.values("H4_m"), ElementsAre(0.55, 0.549));
  EXPECT_THAT(t.values("P2_Pa"), ElementsAre(0, -0.3));
}

TEST_F(ForeignTest, SeveralFilesMeetAtAllTheirTimes) {
  write("a.csv", "t,p\n0,1\n1,2\n2,3\n3,4\n");
  write("b.csv", "t,h\n0.5,10\n2.5,30\n");
  const ProbeTable t = read(mapped("a.csv", "s", "P1", "p", "Pa") + mapped("b.csv", "s", "H1", "h", "mm"));
  EXPECT_THAT(t.times_s(), ElementsAre(0.5, 1, 2, 2.5));
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(1.5, 2, 3, 3.5));
  EXPECT_NEAR(t.values("H1_m")[1], 0.015, 1e-12);
  std::vector<std::string> warnings;
  read_foreign(load_foreign_map(directory / "m.toml"), &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("cover 0 to 3 s together, all of them only 0.5 to 2.5 s")));
}

// Coarse wave gauges first, a fine pressure second: the peak between two rows of the first is not lost.
TEST_F(ForeignTest, NoSampleOfAFinerFileIsLost) {
  write("a.csv", "t,h\n0,10\n50,20\n100,30\n");
  write("b.csv", "t,p\n0,0\n0.02,0\n0.021,9000\n0.022,0\n0.05,0\n0.1,0\n");
  const ProbeTable t = read(mapped("a.csv", "ms", "H1", "h", "mm") + mapped("b.csv", "s", "P1", "p", "Pa"));
  EXPECT_EQ(t.rows(), 6U) << "0.05 s and 50 ms are one time";
  EXPECT_EQ(t.values("P1_Pa")[2], 9000);
  EXPECT_NEAR(t.values("H1_m")[2], 0.0142, 1e-12);
}

// The finer file's times would make a straight line of it, which no report could tell from a result.
TEST_F(ForeignTest, AGapIsNotBridgedByTheTimesOfAnotherFile) {
  std::string pressures = "t,p\n";
  std::string heights = "t,h\n";
  for (int k = 0; k <= 1000; ++k) {
    if (k <= 400 || k >= 600) pressures += fmt::format("{},{}\n", 1e-3 * k, k);
    heights += fmt::format("{},1\n", 1e-3 * k);
  }
  write("a.csv", pressures);
  write("b.csv", heights);
  EXPECT_THAT(refusal(mapped("a.csv", "s", "P1", "p", "Pa") + mapped("b.csv", "s", "H1", "h", "m")),
              AllOf(HasSubstr("a.csv: has no rows between 0.4 and 0.6 s"), HasSubstr("a map of its own")));
  EXPECT_EQ(read(mapped("a.csv", "s", "P1", "p", "Pa")).rows(), 802U) << "by itself the report shows it";
}

TEST_F(ForeignTest, BadFilesAreRefusedByLine) {
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv"), HasSubstr("cannot be opened")));
  write("a.csv", "");
  EXPECT_THAT(refusal(plain), HasSubstr("empty"));
  write("a.csv", "time_s,P1_Pa,H2_m\n");
  EXPECT_THAT(refusal(plain), HasSubstr("no row behind its header (is `header_lines` right"));
  write("a.csv", "time_s,P1_Pa\n0,1\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:1"), HasSubstr("no column \"H2_m\"")));
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0.1,nan,0\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:3"), HasSubstr("P1_Pa")));
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0.2,1,0\n0.1,1,0\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:4"), HasSubstr("sort the rows")));
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0,1,0\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:3"), HasSubstr("repeated")));
  write("a.csv", "time_s;P1_Pa;H2_m\n0;1;0\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:1"), HasSubstr("separator")));
  write("a.csv", "time_s,P1_Pa,H2_m\n0;1,0\n");
  EXPECT_THAT(refusal(plain), HasSubstr("a.csv:2"));
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0,7\n");
  EXPECT_THAT(refusal(plain), AllOf(HasSubstr("a.csv:2"), HasSubstr("4 fields"), HasSubstr("decimal commas")));
}

TEST_F(ForeignTest, GapsAreLeftOutOnRequestAndTold) {
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0.1,,0.1\n0.2,3,NaN\n0.3,4,0.3\n");
  EXPECT_THAT(refusal(plain), HasSubstr("a.csv:3"));
  std::string text = plain;
  text.insert(text.find("time ="), "skip_incomplete_rows = true\n");
  EXPECT_THAT(read(text).times_s(), ElementsAre(0, 0.3));
  import_foreign(load_foreign_map(directory / "m.toml"), directory / "run");
  EXPECT_EQ(read_run(directory / "run").manifest.at("warnings").at(0), "2 incomplete rows of its files were left out");
}

// As spreadsheets export them: a gauge that is not wet yet has an empty cell, the last one of its row too.
TEST_F(ForeignTest, BetweenTabsAFieldMayBeEmptyAtTheEndsOfARow) {
  write("a.csv", "time_s\tP1_Pa\tH2_m\t\n0\t1\t\n\t2\t0.2\n0.2\t3\t0.2\n0.3\t4\t0.3\t\t\n");
  const std::string tabs = std::string("[[files]]\nseparator = \"tab\"\nskip_incomplete_rows = true\n") +
                           (plain + std::string("[[files]]\n").size());
  EXPECT_THAT(read(tabs).times_s(), ElementsAre(0.2, 0.3));
}

TEST_F(ForeignTest, ACaseGivenByItsPathIsRememberedByNameAndPlace) {
  fs::copy_file(load_case("kleefsman").file, directory / "mine.toml");
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n1,1,0\n");
  write("m.toml",
        fmt::format("case = \"{}\"\nsolver = \"other\"\nl0_m = 0.02\n{}", (directory / "mine.toml").string(), plain));
  import_foreign(load_foreign_map(directory / "m.toml"), directory / "run");
  const RunRecord record = read_run(directory / "run");
  EXPECT_EQ(record.case_name, "kleefsman");
  EXPECT_EQ(record.text("case_file"), (directory / "mine.toml").string());
}

TEST_F(ForeignTest, BadMapsAreRefusedByLineAndKey) {
  write("a.csv", "t,p\n0,1\n1,2\n");
  const auto with = [](const std::string& column) {
    return "[[files]]\nfile = \"a.csv\"\ntime = { column = \"t\", unit = \"s\" }\ncolumns = [ " + column + " ]\n";
  };
  EXPECT_THAT(refusal(with("{ sensor = \"P9\", column = \"p\", unit = \"Pa\" }")),
              AllOf(HasSubstr("m.toml:7"), HasSubstr("P9")));
  EXPECT_THAT(refusal(with("{ sensor = \"P1\", column = \"p\", unit = \"m\" }")), HasSubstr("kPa"));
  EXPECT_THAT(refusal(with("{ sensor = \"P1\", column = \"p\" }")), HasSubstr("unit"));
  EXPECT_THAT(
      refusal(with("{ sensor = \"P1\", column = \"p\", unit = \"Pa\" }, { sensor = \"P1\", column = \"p\", unit "
                   "= \"Pa\" }")),
      HasSubstr("given twice"));
  EXPECT_THAT(refusal("[[files]]\nfile = \"a.csv\"\ndecimal_comma = true\n"), HasSubstr("decimal_comma"));
  EXPECT_THAT(refusal("[[files]]\nfile = \"a\\tcsv\"\n"), AllOf(HasSubstr("m.toml:"), HasSubstr("control character")));
}

TEST_F(ForeignTest, OneColumnMayFeedTimeAndSensors) {
  write("a.csv", "t,p\n0,1\n1,2\n");
  const ProbeTable t = read(R"([[files]]
file = "a.csv"
time = { column = "t", unit = "s" }
columns = [ { sensor = "P1", column = "t", unit = "Pa" }, { sensor = "P2", column = "t", unit = "kPa" } ]
)");
  EXPECT_THAT(t.times_s(), ElementsAre(0, 1));
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(0, 1));
  EXPECT_THAT(t.values("P2_Pa"), ElementsAre(0, 1000));
}

TEST_F(ForeignTest, ScalingThatLosesTheSeriesIsRefused) {
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1e307,0\n1e-9,1,0\n");
  std::string text = plain;
  EXPECT_THAT(refusal(text.replace(text.find("unit = \"s\""), 10, "unit = \"s\", offset_s = 1e12")),
              AllOf(HasSubstr("a.csv: time_s: "), HasSubstr("do not stay apart")));
  text = plain;
  EXPECT_THAT(refusal(text.replace(text.find("unit = \"Pa\""), 11, "unit = \"MPa\"")),
              AllOf(HasSubstr("a.csv: P1_Pa: "), HasSubstr("does not stay finite")));
}

TEST_F(ForeignTest, AnUnknownCaseIsNamedByLine) {
  write("m.toml", "case = \"kleefman\"\nsolver = \"other\"\nl0_m = 0.02\n");
  EXPECT_THAT([&] { load_foreign_map(directory / "m.toml"); },
              testing::ThrowsMessage<CaseError>(HasSubstr("m.toml:1: case: no case `kleefman`")));
}

TEST_F(ForeignTest, AnImportedRunReadsLikeAnyOther) {
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0.1,2,0.1\n");
  read(plain);
  import_foreign(load_foreign_map(directory / "m.toml"), directory / "run");
  const RunRecord run = read_run(directory / "run");
  EXPECT_EQ(run.solver, "other");
  EXPECT_FALSE(run.own);
  EXPECT_THAT(run.probes.values("P1_Pa"), ElementsAre(1, 2));
  EXPECT_TRUE(run.manifest.at("imported_from").at(0).contains("hash"));
  EXPECT_FALSE(run.alpha());
}

/// Without these a code's runs could take part in no study of alpha or of cost.
TEST_F(ForeignTest, AlphaAndCostMayBeTold) {
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n0.1,2,0.1\n");
  read("alpha = 0.05\nwalls = \"their own\"\ncpu_time_s = 120\nsteps = 4000\n" + std::string(plain));
  import_foreign(load_foreign_map(directory / "m.toml"), directory / "run");
  const RunRecord run = read_run(directory / "run");
  EXPECT_EQ(run.alpha(), 0.05);
  EXPECT_EQ(run.walls, "their own");
  EXPECT_EQ(run.number("cpu_time_s"), 120);
  EXPECT_EQ(run.number("steps"), 4000);
  EXPECT_THAT(refusal("alpha = -1\n" + std::string(plain)), HasSubstr("m.toml:4: alpha"));
}

TEST_F(ForeignTest, RemediesAreNamedWhereNothingCanBeReadOrWritten) {
  write("a.csv", "time_s,P1_Pa,H2_m\n0,,0\n");
  std::string text = plain;
  text.insert(text.find("time ="), "skip_incomplete_rows = true\n");
  EXPECT_THAT(refusal(text), HasSubstr("no row behind its header that is complete (map only"));
  text = plain;
  text.insert(text.find("time ="), "header_lines = 3\n");
  EXPECT_THAT(refusal(text), AllOf(HasSubstr("a.csv:2"), HasSubstr("ends within its header (is it cut short")));
  write("a.csv", "time_s,P1_Pa,H2_m\n0,1,0\n");
  read(plain);
  EXPECT_THAT([&] { import_foreign(load_foreign_map(directory / "m.toml"), directory / "a.csv" / "run"); },
              testing::ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cannot be made"), HasSubstr("in its way"))));
}

TEST(VolumeOfFluidMaps, ExpectTheRawFileInTheRawFolder) {
  for (const char* map : {"data/vof_kleefsman/interfoam.toml", "data/vof_kleefsman/interfoam_p2.toml"})
    EXPECT_EQ(load_foreign_map(map).files.at(0).file.lexically_normal(),
              fs::path("../shared/data/vof_kleefsman/interfoam_161x50x50.csv"))
        << map;
}

/// A real delivery of another code. Expected values were read from the raw file, which stays with its owner.
TEST_F(ForeignTest, TheVolumeOfFluidSeriesIsReadRowByRow) {
  const fs::path raw = raw_data_folder() / "vof_kleefsman/interfoam_161x50x50.csv";
  if (!fs::exists(raw))
    GTEST_SKIP() << "the raw series is not part of the project and " << raw.string()
                 << " is not there; set SLUICE_RAW_DATA to the folder of raw data";
  EXPECT_EQ(file_hash(raw), "fnv1a64:2848ab176d2eca1c");
  ForeignMap map = load_foreign_map("data/vof_kleefsman/interfoam.toml");
  map.files.at(0).file = raw;
  std::vector<std::string> warnings;
  const ProbeTable whole = read_foreign(map, &warnings);
  EXPECT_THAT(whole.names(), ElementsAre("P1_Pa", "H2_m", "H4_m"));
  ASSERT_EQ(whole.rows(), 557u);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(whole.times_s().front(), 0.0089);
  EXPECT_EQ(whole.times_s().back(), 5.9957);
  EXPECT_EQ(whole.times_s()[29], 0.4411);  // line 31 of the file
  EXPECT_EQ(whole.values("P1_Pa")[29], 9838.2629);
  EXPECT_EQ(whole.values("H2_m")[29], 0.0740);
  EXPECT_EQ(whole.values("H4_m")[29], 0.4589);
  map = load_foreign_map("data/vof_kleefsman/interfoam_p2.toml");
  map.files.at(0).file = raw;
  import_foreign(map, directory / "p2");
  const RunRecord p2 = read_run(directory / "p2");
  EXPECT_EQ(p2.solver, "interFoam (OpenFOAM v2312), P2");
  EXPECT_EQ(p2.probes.rows(), 552u);
  EXPECT_EQ(p2.probes.times_s().back(), 5.8909);
  EXPECT_NEAR(p2.probes.values("P2_Pa")[32], 8248.2787, 1e-4);  // line 34; run directories keep nine digits
  EXPECT_EQ(p2.manifest.at("warnings").at(0), "5 incomplete rows of its files were left out");
}

}  // namespace
}  // namespace sluice
