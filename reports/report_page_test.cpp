// The report as its readers meet it: in a browser on a desk and on a telephone, on paper, and in a LaTeX document.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "reports/report.h"
#include "reports/synthetic_run.h"
#include "reports/test_files.h"
#include "reports/webdriver.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using test_files::fresh;
using test_files::read;

/// Three resolutions, two alphas, both walls, another code and pictures of the flow: every section has something.
fs::path make_pressure_report() {
  std::vector<fs::path> runs;
  const auto add = [&](const synthetic::MadeRun& made) {
    runs.push_back(fresh("page_run_" + std::to_string(runs.size())));
    synthetic::write_run(runs.back(), made);
  };
  add({.noise_Pa = 300});
  synthetic::write_snapshots(runs.front(), {0.5, 1.05}, 0.05);
  add({.l0_m = 0.03, .scale = 1.2});
  add({.l0_m = 0.015, .scale = 1.05});
  add({.alpha = 0.001, .scale = 0.95});
  add({.walls = "dynamic", .scale = 0.6});
  add({.solver = "mps", .walls = "dummies", .scale = 0.97});
  runs.push_back(fresh("page_external"));
  synthetic::write_external_run(runs.back(), 0.9);
  fs::path out = fresh("page_out");
  write_report(runs, out);
  return out;
}

/// Three resolutions, three alphas, both walls and both solvers of a case with a force. Where the case leaves a length
/// open, another value of it is in the place of an alpha.
fs::path make_force_report(const std::string& case_name) {
  std::vector<synthetic::MadeForceRun> made{{.noise_N = 0.4},
                                            {.alpha = 0.1, .scale = 0.9, .noise_N = 0.2},
                                            {.alpha = 0.001, .scale = 0.95, .noise_N = 0.6},
                                            {.l0_m = 0.02, .scale = 1.2},
                                            {.l0_m = 0.01, .scale = 1.05},
                                            {.walls = "dynamic", .scale = 0.8},
                                            {.solver = "mps", .walls = "dummies", .scale = 0.97}};
  const synthetic::MadeForceRun nearer{.shift_s = -0.05, .parameters = {{"block_distance_m", 0.45}}};
  if (case_name == "aureli") made[2] = nearer;
  std::vector<fs::path> runs;
  for (synthetic::MadeForceRun& run : made) {
    run.case_name = case_name;
    runs.push_back(fresh(fmt::format("page_{}_run_{}", case_name, runs.size())));
    synthetic::write_force_run(runs.back(), run);
  }
  fs::path out = fresh("page_out_" + case_name);
  write_report(runs, out);
  return out;
}

/// A case's report, written when it is first asked for.
const fs::path& report_on(const std::string& case_name) {
  static std::map<std::string, fs::path> written;
  if (!written.contains(case_name))
    written[case_name] = case_name == "kleefsman" ? make_pressure_report() : make_force_report(case_name);
  return written.at(case_name);
}

/// With pressures and wave heights, with a measured force, and with a force that was not measured.
const auto every_case = testing::Values("kleefsman", "column", "aureli");
std::string name_of(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class ReportPage : public testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() {
    const BrowserPrograms programs = find_browser();
    if (programs.present()) browser.emplace(programs, fresh("page_profile"));
  }
  static void TearDownTestSuite() { browser.reset(); }

  void open(int width) {
    browser->resize(width, 900);
    browser->open(report() / "index.html");
  }
  void SetUp() override {
    if (!browser) GTEST_SKIP() << "no chromium and chromedriver (Debian: apt-get install chromium chromium-driver)";
  }
  void TearDown() override {
    if (!browser) return;
    browser->set_medium("");
    EXPECT_THAT(browser->complaints(), testing::IsEmpty());
    // For people who want to look: SLUICE_SCREENSHOTS=directory.
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    if (const char* to = std::getenv("SLUICE_SCREENSHOTS"); to != nullptr)
      browser->screenshot(fs::path(to) / (name + ".png"));
  }

  static const fs::path& report() { return report_on(GetParam()); }
  /// Fewer are drawn of one force than of eight pressures and four wave heights.
  static int least_pictures() { return GetParam() == "kleefsman" ? 21 : 7; }

  /// What sticks out of the page on the right. A table in a box that scrolls by itself does not.
  static std::string sticking_out() {
    return browser
        ->evaluate(
            "const wide = document.documentElement.clientWidth + 1;"
            "if (document.documentElement.scrollWidth <= wide) return '';"
            "return [...document.querySelectorAll('body *')].filter(e => e.getBoundingClientRect().right > wide)"
            ".slice(0, 5).map(e => e.tagName + '.' + e.className + ' ' + e.textContent.slice(0, 40)).join('; ') || "
            "'?';")
        .get<std::string>();
  }

  static std::optional<Browser> browser;
};
std::optional<Browser> ReportPage::browser;
INSTANTIATE_TEST_SUITE_P(Cases, ReportPage, every_case, name_of);

TEST_P(ReportPage, EveryPictureIsThere) {
  open(1280);
  EXPECT_GE(browser->evaluate("return document.images.length + document.querySelectorAll('svg').length").get<int>(),
            least_pictures());
  EXPECT_EQ(browser->evaluate("return [...document.images].filter(i => !i.complete || i.naturalWidth === 0).length"),
            0);
}

TEST_P(ReportPage, FitsADesk) {
  open(1280);
  EXPECT_EQ(sticking_out(), "");
}

TEST_P(ReportPage, FitsATelephone) {
  open(400);
  EXPECT_EQ(sticking_out(), "");
  const double smallest_px = browser
                                 ->evaluate(
                                     "return Math.min(...[...document.querySelectorAll('p, li, td, th')]"
                                     ".map(e => parseFloat(getComputedStyle(e).fontSize)))")
                                 .get<double>();
  EXPECT_GE(smallest_px, 10);
}

/// A table that scrolls on the screen would be cut off on paper.
TEST_P(ReportPage, NothingIsCutOffOnPaper) {
  open(1030);  // what an A4 page, laid across, has between its margins
  browser->set_medium("print");
  EXPECT_EQ(sticking_out(), "");
  const auto cut = browser->evaluate(
      "return [...document.querySelectorAll('body *')]"
      ".filter(e => getComputedStyle(e).overflowX !== 'visible' && e.scrollWidth > e.clientWidth + 1)"
      ".map(e => e.tagName + '.' + e.className + ' ' + e.textContent.trim().slice(0, 40)).slice(0, 5).join('; ')");
  EXPECT_EQ(cut, "");
  const fs::path pdf = report() / "print.pdf";
  browser->print(pdf);
  EXPECT_TRUE(read(pdf).starts_with("%PDF"));
  EXPECT_GT(fs::file_size(pdf), 4800U * least_pictures()) << "[bytes] as if pictures were missing";
}

class ReportTables : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Cases, ReportTables, every_case, name_of);

/// Each alone, and all in one document.
TEST_P(ReportTables, CompileWithLatex) {
  if (std::system("command -v latexmk > /dev/null") != 0)
    GTEST_SKIP() << "no latexmk (Debian: apt-get install latexmk texlive-latex-recommended)";
  const fs::path& out = report_on(GetParam());
  std::string inputs;
  std::string files = "all.tex";
  for (const auto& entry : fs::directory_iterator(out / "tables")) {
    if (entry.path().extension() != ".tex") continue;
    inputs += fmt::format("\\input{{{}}}\n", entry.path().filename().string());
    files += fmt::format(" {}", entry.path().filename().string());
  }
  std::ofstream(out / "tables" / "all.tex")
      << "\\documentclass{article}\n\\usepackage[T1]{fontenc}\n\\usepackage{booktabs,graphicx,longtable}\n"
         "\\begin{document}\n"
      << inputs << "\\end{document}\n";
  const std::string command =
      fmt::format("cd '{}' && latexmk -pdf -interaction=nonstopmode -halt-on-error {} > latex.txt 2>&1",
                  (out / "tables").string(), files);
  ASSERT_EQ(std::system(command.c_str()), 0) << read(out / "tables" / "latex.txt").substr(0, 20000);
  EXPECT_TRUE(fs::exists(out / "tables" / "all.pdf"));
}

}  // namespace
}  // namespace sluice
