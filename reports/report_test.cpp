#include "reports/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "reports/synthetic_run.h"
#include "reports/test_files.h"
#include "validation/measurements.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeRun;

using test_files::fresh;
using test_files::read;

class WholeReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const fs::path run = fresh("whole_run");
    MadeRun made;
    made.noise_Pa = 300;
    synthetic::write_run(run, made);
    synthetic::write_snapshots(run, {0.5, 1.05}, 0.05);
    const fs::path other = fresh("whole_other");
    made.walls = "dynamic";
    made.scale = 0.6;
    synthetic::write_run(other, made);
    const fs::path external = fresh("whole_external");
    synthetic::write_external_run(external, 0.9);
    out = fresh("whole_out");
    write_report({run, other, external}, out);
  }
  static fs::path out;
};
fs::path WholeReport::out;

TEST(Report, TakesAwayWhatTheOneBeforeLinkedToAndNothingElse) {
  const fs::path run = fresh("again_run");
  synthetic::write_run(run, {});
  const fs::path again = fresh("again_out");
  fs::create_directories(again / "tables");
  fs::create_directories(again / "figures");
  for (const char* file : {"tables/early_runs.csv", "figures/old.svg", "tables/mine.csv"}) std::ofstream(again / file);
  std::ofstream(again / "report.md") << "[CSV](tables/early_runs.csv) ![a](figures/old.svg) [x](../again_run/run.json)";
  ReportOptions options;
  options.figures = false;
  write_report({run}, again, options);
  EXPECT_FALSE(fs::exists(again / "tables/early_runs.csv"));
  EXPECT_FALSE(fs::exists(again / "figures/old.svg"));
  EXPECT_TRUE(fs::exists(again / "tables/mine.csv"));
  EXPECT_TRUE(fs::exists(run / "run.json"));
  EXPECT_TRUE(fs::exists(again / "tables/runs.csv"));
}

TEST_F(WholeReport, ThePageMakesNoRequests) {
  const std::string html = read(out / "index.html");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  for (const char* attribute : {" src=\"", " href=\"", " href='"})
    for (std::size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1)) {
      const std::string target = html.substr(at + std::string(attribute).size(), 5);
      EXPECT_TRUE(target.starts_with("#") || target == "data:") << html.substr(at, 60);
    }
}

TEST_F(WholeReport, ThePageEscapesWhatOthersWrote) {
  const std::string html = read(out / "index.html");
  EXPECT_NE(html.find("interFoam &amp; &lt;friends&gt;"), std::string::npos);
  EXPECT_EQ(html.find("<friends>"), std::string::npos);
}

TEST_F(WholeReport, IdentifiersOfThePageAreUnique) {
  const std::string html = read(out / "index.html");
  std::map<std::string, int> seen;
  for (const char quote : {'"', '\''}) {
    const std::string mark = std::string(" id=") + quote;
    for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at + 1)) {
      const std::size_t begin = at + mark.size();
      ++seen[html.substr(begin, html.find(quote, begin) - begin)];
    }
  }
  EXPECT_GT(seen.size(), 20u);
  for (const auto& [id, count] : seen) EXPECT_EQ(count, 1) << id;
}

TEST_F(WholeReport, AnchorsOfThePageExist) {
  const std::string html = read(out / "index.html");
  for (std::size_t at = html.find("<a href=\"#"); at != std::string::npos; at = html.find("<a href=\"#", at + 1)) {
    const std::size_t begin = at + 10;
    const std::string id = html.substr(begin, html.find('"', begin) - begin);
    EXPECT_NE(html.find("id=\"" + id + "\""), std::string::npos) << id;
  }
}

TEST_F(WholeReport, WritesEveryFormat) {
  for (const char* file :
       {"report.md", "tables/table1_parameters.csv", "tables/table2_impulses.tex", "tables/acceptance.csv",
        "figures/pressure_P1.svg", "figures/pressure_P1.gp", "figures/pressure_P1.dat", "figures/impact_P8.svg",
        "figures/wave_H4.svg", "figures/pressure_sensors.svg", "figures/walls_R1_R2.svg", "figures/snapshots_R1.png"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  const std::string markdown = read(out / "report.md");
  EXPECT_NE(markdown.find("(figures/wave_H2.svg)"), std::string::npos);
  EXPECT_NE(markdown.find("FreSCo and ConFlow"), std::string::npos) << "what is not available is said";
}

TEST_F(WholeReport, SnapshotsSayWhatThePapersFigureHasOtherwise) {
  EXPECT_NE(read(out / "report.md").find("after the paper's figure 3, which has WCSPH at α = 0.0001 and l0 = 7.5 mm"),
            std::string::npos);
}

TEST_F(WholeReport, LongViewsShowAllOfTheMeasuredBand) {
  const Measurements measured = Measurements::load(load_case("kleefsman"));
  const std::vector<double>& maxima = measured.find("P1")->maximum;
  const std::string script = read(out / "figures/pressure_P1.gp");
  const std::size_t at = script.find(':', script.find("set yrange ["));
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(1000 * std::stod(script.substr(at + 1)), *std::max_element(maxima.begin(), maxima.end()));
}

TEST_F(WholeReport, SaysWhyAValueMayBeMissing) {
  for (const char* reason : {"nobody measured it", "record it", "far enough", "threshold", "limit of the search"})
    EXPECT_NE(read(out / "index.html").find(reason), std::string::npos) << reason;
}

TEST_F(WholeReport, NamesNoPathOfTheMachine) {
  const std::string temporary = fs::path(testing::TempDir()).lexically_normal().parent_path().string();
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".png") continue;
    EXPECT_EQ(read(entry.path()).find(temporary), std::string::npos) << entry.path();
  }
}

TEST(Report, ErrorsNameWhatIsWrongAndTheRemedy) {
  EXPECT_THROW(write_report({}, fresh("none")), std::runtime_error);
  try {
    write_report({"no/such/run"}, fresh("none"));
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/run"), std::string::npos) << error.what();
  }
}

TEST(Report, TablesAloneNeedNoGnuplot) {
  const fs::path run = fresh("tables_run");
  const fs::path out = fresh("tables_out");
  synthetic::write_run(run, {});
  ReportOptions options;
  options.figures = false;
  write_report({run}, out, options);
  EXPECT_FALSE(fs::exists(out / "figures"));
  EXPECT_TRUE(fs::exists(out / "index.html"));
}

}  // namespace
}  // namespace sluice
