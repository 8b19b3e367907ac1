#include "validation/foreign_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "validation/foreign_test.h"

namespace sluice {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

using foreign_test::ForeignTest;
using foreign_test::mapped;
using foreign_test::plain;

TEST_F(ForeignTest, BlanksAndNumbersForNames) {
  write("a.dat", "0.0   10  1\n0.1\t20  2\n");
  const ProbeTable t = read(R"([[files]]
file = "a.dat"
separator = "blank"
header_lines = 0
time = { column = "1", unit = "s" }
columns = [ { sensor = "P2", column = "3", unit = "hPa" } ]
)");
  EXPECT_THAT(t.values("P2_Pa"), ElementsAre(100, 200));
}

/// As OpenFOAM's function object `probes` writes them.
TEST_F(ForeignTest, CommentsForAHeaderNameTheFirstColumn) {
  write("p.dat", "# Probe 0 (0.66 0.5 0.02)\n#       Probe  0   1\n#        Time\n  0.0   10  1\n  0.1   20  2\n");
  const std::string map = R"([[files]]
file = "p.dat"
separator = "blank"
header_lines = 3
time = { column = "Time", unit = "s" }
columns = [ { sensor = "P2", column = "3", unit = "hPa" } ]
)";
  EXPECT_THAT(read(map).values("P2_Pa"), ElementsAre(100, 200));
  write("p.dat", "# a comment\n\n# t p\n0 1 2\n");
  EXPECT_THAT(refusal(map), HasSubstr("no column \"Time\"; there are 3: t | 2 | 3"))
      << "which column `p` is nobody can tell";
}

TEST_F(ForeignTest, ACommentsNamesStandOverTheirColumns) {
  const std::string tabs = mapped("t.txt", "s", "P1", "p", "Pa").replace(0, 9, "[[files]]\nseparator = \"tab\"\n");
  write("t.txt", "# t\tp\n0\t1\t\n1\t2\t\n");
  EXPECT_THAT(read(tabs).values("P1_Pa"), ElementsAre(1, 2)) << "a tab at each row's end";
  write("t.txt", "#\tt\tp\n0\t1\n1\t2\n");
  EXPECT_THAT(read(tabs).values("P1_Pa"), ElementsAre(1, 2)) << "a tab behind the mark";
  write("t.txt", "# t\tp\n");
  EXPECT_THAT(refusal(tabs), HasSubstr("holds no row behind its header"));
}

TEST_F(ForeignTest, QuotesAroundNamesAreNotTheirs) {
  write("q.csv", "\"time [s]\",\"p\"\n0,1\n0.5,2\n");
  const ProbeTable t = read(R"([[files]]
file = "q.csv"
time = { column = "time [s]", unit = "s" }
columns = [ { sensor = "P1", column = "p", unit = "kPa" } ]
)");
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(1000, 2000));
}

/// A map's entry for time and P1 in columns that go by number.
std::string numbered(const std::string& settings) {
  return "[[files]]\nfile = \"n.dat\"\n" + settings +
         "\ntime = { column = \"1\", unit = \"s\" }\ncolumns = [ { sensor = \"P1\", column = \"2\", unit = \"Pa\" } "
         "]\n";
}

TEST_F(ForeignTest, AHeaderWithAnotherNumberOfNamesLeavesNumbers) {
  const std::string blanks = numbered("separator = \"blank\"");
  write("n.dat", "Time [s]  P1 [Pa]\n0.0  1\n0.5  2\n");
  EXPECT_THAT(read(blanks).values("P1_Pa"), ElementsAre(1, 2)) << "blanks in names between blanks";
  write("n.dat", "# Time [s]  P1 [Pa]\n0.0  1\n0.5  2\n");
  EXPECT_THAT(read(blanks).values("P1_Pa"), ElementsAre(1, 2)) << "more names than columns behind a comment's mark";
  write("n.dat", "VARIABLES = \"t\", \"P1\"\nZONE T=\"gauge\"\n0.0  1\n0.5  2\n");
  EXPECT_THAT(read(numbered("separator = \"blank\"\nheader_lines = 2")).values("P1_Pa"), ElementsAre(1, 2))
      << "Tecplot";
  write("n.dat", "pressure at the box\n0.0,1\n0.5,2\n");
  EXPECT_THAT(read(numbered("")).values("P1_Pa"), ElementsAre(1, 2)) << "a title";
  write("n.dat", "pressure at the box\n");
  EXPECT_THAT(refusal(numbered("")), AnyOf(HasSubstr("no column"), HasSubstr("no row behind its header")));
}

TEST_F(ForeignTest, NamesThatDoNotFitTheRowsAreNotGuessed) {
  std::string named = numbered("separator = \"blank\"");
  named.replace(named.find("\"1\""), 3, "\"Time\"");
  write("n.dat", "Time [s]  P1 [Pa]\n0.0  1\n0.5  2\n");
  EXPECT_THAT(
      refusal(named),
      AllOf(HasSubstr("n.dat:2: 2 fields where the header has 4 names, so that none can be told to be \"Time\""),
            HasSubstr("by their numbers, 1 to 2")));
}

// As spreadsheets write fields that hold their separator, and some write all of them.
TEST_F(ForeignTest, QuotesMayStandAroundAnyField) {
  write("n.dat",
        "\"t\";\"P1; raw\";\"note\"\n\"0,5\";\"12,3\";\"calm; dry\"\n\"1,5\"; \"-1,0\" ;\"a \"\"wet\"\" one\"\n");
  std::string map = numbered("separator = \";\"\ndecimal_comma = true");
  map.replace(map.find("\"2\""), 3, "\"P1; raw\"");
  const ProbeTable t = read(map);
  EXPECT_THAT(t.times_s(), ElementsAre(0.5, 1.5));
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(12.3, -1));
  write("n.dat", "\"Time [s]\" \"P1 [Pa]\"\n0.0  1\n0.5  2\n");
  map = numbered("separator = \"blank\"");
  map.replace(map.find("\"2\""), 3, "\"P1 [Pa]\"");
  EXPECT_THAT(read(map).values("P1_Pa"), ElementsAre(1, 2)) << "between blanks";
  write("n.dat", "t,p\n0,\"1\n0.5,2\n");
  EXPECT_THAT(refusal(numbered("")), HasSubstr("n.dat:2: p: \"\"1\" is not a number")) << "one quote is none";
}

TEST_F(ForeignTest, ExponentsMayBeFortrans) {
  write("n.dat", "t,p\n0.0D+00,1.000D-03\n5.d-1,+2D3\n");
  const ProbeTable t = read(numbered(""));
  EXPECT_THAT(t.times_s(), ElementsAre(0, 0.5));
  EXPECT_THAT(t.values("P1_Pa"), ElementsAre(1e-3, 2000));
}

TEST_F(ForeignTest, ASeparatorAtARowsEndIsNoColumn) {
  for (const char* text : {"t,p\n0,1,\n0.5,2,\n", "t,p,\n0,1,\n0.5,2,\n", "t,p,\n0,1\n0.5,2\n", "t,p\n0,1\n0.5,2,\n"}) {
    write("n.dat", text);
    EXPECT_THAT(read(numbered("")).values("P1_Pa"), ElementsAre(1, 2)) << text;
  }
  write("n.dat", "0;1;\n0.5;2;\n");
  EXPECT_THAT(read(numbered("separator = \";\"\nheader_lines = 0")).values("P1_Pa"), ElementsAre(1, 2));
  write("n.dat", "t,p\n0,1,,\n0.5,2,,\n");
  EXPECT_THAT(refusal(mapped("n.dat", "s", "P1", "p", "Pa")), HasSubstr("n.dat:2: 4 fields")) << "two are a column";
}

TEST_F(ForeignTest, ALastValueThatIsMissingIsNoSeparatorTooMany) {
  for (const char* text : {"time_s,P1_Pa,H2_m\n0,1,\n0.1,2,\n", "time_s,P1_Pa,H2_m,\n0,1,,\n0.1,2,,\n"}) {
    write("a.csv", text);
    EXPECT_THAT(refusal(plain), HasSubstr("a.csv:2: H2_m: \"\" is not a number; ")) << text;
  }
}

}  // namespace
}  // namespace sluice
