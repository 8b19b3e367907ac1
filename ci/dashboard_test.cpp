#include "ci/dashboard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "ci/made_results.h"
#include "reports/webdriver.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(DashboardPage, NothingInTheLedgerCanEndItsScript) {
  Ledger ledger;
  Result r = made::result(1, "steps", "</script><b>", 1);
  r.commit = "<!-- \xff";
  ledger.results.push_back(r);
  const std::string page = dashboard_page(ledger, find_all(ledger), ".");
  EXPECT_THAT(page, AllOf(Not(HasSubstr("</script><b>")), HasSubstr("\\u003c/script>")));
}

TEST(DashboardPage, LinksLeadToWebAddressesAndToFilesThatAreThere) {
  const fs::path there = fs::path(testing::TempDir()) / "sluice-a-run";
  fs::create_directories(there);
  Ledger ledger;
  for (const std::string& link : {std::string("https://example.org/a"), there.string(), std::string("not/there"),
                                  std::string("javascript:alert(1)")}) {
    Result r = made::result(static_cast<int>(ledger.results.size()), "steps", "", 1);
    r.link = link;
    ledger.results.push_back(r);
  }
  const std::string page = dashboard_page(ledger, find_all(ledger), testing::TempDir());
  EXPECT_THAT(page, AllOf(HasSubstr("\"href\":\"https://example.org/a\""), HasSubstr("\"href\":\"sluice-a-run\""),
                          Not(HasSubstr("\"href\":\"not")), Not(HasSubstr("\"href\":\"java"))));
  fs::remove_all(there);
}

TEST(DashboardPage, IsWrittenWholeOrNot) {
  EXPECT_THROW(write_dashboard("/proc/no/page.html", Ledger{}, {}), std::runtime_error);
}

/// The example's page in a headless browser, cut off from every network.
class DashboardInBrowser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory = fs::path(testing::TempDir()) / "sluice-dashboard";
    fs::remove_all(directory);
    fs::create_directories(directory / "profile");
    const Ledger ledger = made::example();
    write_dashboard(directory / "index.html", ledger, find_all(ledger));
    const BrowserPrograms programs = find_browser();
    if (programs.present()) browser.emplace(programs, directory / "profile");
  }
  static void TearDownTestSuite() {
    browser.reset();
    fs::remove_all(directory);
  }

  void SetUp() override {
    if (!browser) GTEST_SKIP() << "no chromium and chromedriver (Debian: apt-get install chromium chromium-driver)";
    browser->resize(1280, 900);
    browser->open(directory / "index.html");
  }
  void TearDown() override {
    if (!browser) return;
    EXPECT_THAT(browser->complaints(), IsEmpty());
    // For people who want to look: SLUICE_SCREENSHOTS=directory.
    if (const char* to = std::getenv("SLUICE_SCREENSHOTS"); to != nullptr)
      browser->screenshot(fs::path(to) /
                          (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".png"));
  }

  static void choose(const std::string& select, const std::string& value) {
    browser->click("#" + select + " option[value='" + value + "']");
  }

  static inline fs::path directory;
  static inline std::optional<Browser> browser;
};

TEST_F(DashboardInBrowser, ShowsWhatIsOpenFirst) {
  EXPECT_THAT(browser->text("#subtitle"), AllOf(HasSubstr("series of 400 runs"), HasSubstr("2026-03-21"),
                                                HasSubstr("damaged line(s) of the ledger left out: 17")));
  EXPECT_THAT(browser->text("#state"), HasSubstr("open regressions in this selection"));
  EXPECT_THAT(browser->text(".finding-row"), AllOf(HasSubstr("open"), HasSubstr("since c")));
  EXPECT_THAT(browser->text(".finding-row.accepted"), HasSubstr("the bed's friction <is> taken into account"));
  EXPECT_EQ(browser->evaluate("return performance.getEntriesByType('resource').length"), 0) << "nothing is loaded";
}

TEST_F(DashboardInBrowser, FiltersByCaseSolverFamilyAndWords) {
  choose("solver", "mps");
  EXPECT_EQ(
      browser->evaluate(
          "return [...document.querySelectorAll('.card p:first-of-type')].every(p => p.textContent.includes(' mps'))"),
      true);
  choose("family", "cost");
  EXPECT_EQ(browser->count(".card"), 6u) << "three costs at two resolutions";
  choose("case", "benchmark");
  EXPECT_EQ(browser->count(".card"), 0u);
  EXPECT_THAT(browser->text("#cards"), HasSubstr("No series fits"));
  browser->click("#clear");
  browser->type("#search", "H2 0.02");
  EXPECT_EQ(browser->count(".card"), 2u);
  browser->click("#clear");
  choose("show", "open");
  EXPECT_EQ(browser->count(".card"), browser->count(".card.open"));
  EXPECT_GE(browser->count(".card"), 7u);
}

TEST_F(DashboardInBrowser, AClickOnADotTellsWhereItComesFrom) {
  browser->type("#search", "time_per_iteration_s");
  ASSERT_EQ(browser->count(".card"), 1u);
  EXPECT_FALSE(browser->shown("#provenance"));
  browser->click(".card .dot:nth-of-type(40)");  // circles only: the 40th night
  EXPECT_TRUE(browser->shown("#provenance"));
  EXPECT_THAT(browser->text("#provenance"),
              AllOf(HasSubstr("time_per_iteration_s of wcsph/pair_sums/100000"), HasSubstr("c039"),
                    HasSubstr("2026-02-09T03:00:00Z"),
                    HasSubstr("a processor (1/2/3), 8 processors, 16 GiB; 8 threads"), HasSubstr("g++ 12.2.0 -O3")));
  EXPECT_EQ(browser->evaluate("return document.querySelector('#provenance a').href"),
            "https://example.org/bench/39?a=1&b=2");
  EXPECT_THAT(browser->text(".card .readout"), HasSubstr("c039"));
  browser->click("#close");
  browser->click_beside(".card svg", 150, 0);
  EXPECT_THAT(browser->text("#provenance"), Not(HasSubstr("c039"))) << "another dot";
  browser->click("#close");
  EXPECT_FALSE(browser->shown("#provenance"));
}

TEST_F(DashboardInBrowser, KeysGoFromDotToDot) {
  browser->type("#search", "time_per_iteration_s");
  browser->type(".card svg", std::string(keys::home) + keys::right + keys::right);
  EXPECT_THAT(browser->text(".card .readout"), HasSubstr("c002"));
  browser->type(".card svg", std::string(keys::left) + keys::enter);
  EXPECT_THAT(browser->text("#provenance"), HasSubstr("c001"));
  browser->type(".card svg", keys::escape);
  EXPECT_FALSE(browser->shown("#provenance"));
}

TEST_F(DashboardInBrowser, AFindingLeadsToItsSeriesWithTheChangeMarked) {
  browser->type("#search", "impulse_deviation nearest P1");
  const std::string name = browser->text(".finding-row button");
  browser->click(".finding-row button");
  EXPECT_EQ(browser->count(".card"), 1u);
  EXPECT_EQ(browser->text(".card h3"), name);
  EXPECT_EQ(browser->count(".card .finding.worse"), 1u);
  EXPECT_EQ(browser->count(".card .change"), 1u);
  EXPECT_EQ(browser->count(".card .level"), 2u);
  browser->click("#clear");
  browser->type("#search", "rmse wcsph");
  EXPECT_EQ(browser->count(".card .finding .hollow"), 2u) << "accepted ones are hollow";
}

TEST_F(DashboardInBrowser, ErrorAgainstCostUpToANight) {
  EXPECT_EQ(browser->count("#error-cost-key li"), 4u);
  const std::string last = browser->text("#error-cost-key li");
  browser->type("#night", keys::home);
  EXPECT_EQ(browser->text("#night-name"), "2026-01-01");
  EXPECT_NE(browser->text("#error-cost-key li"), last);
  EXPECT_EQ(browser->count("#error-cost-chart .faint"), 0u);
  browser->type("#night", keys::right);
  EXPECT_EQ(browser->count("#error-cost-chart .faint"), 4u);
  choose("solver", "wcsph");
  EXPECT_EQ(browser->count("#error-cost-key li"), 2u);
}

TEST_F(DashboardInBrowser, ShowsMoreOnDemand) {
  EXPECT_EQ(browser->count(".card"), 24u);
  browser->click("#more");
  EXPECT_EQ(browser->count(".card"), 37u);
  EXPECT_FALSE(browser->shown("#more"));
}

class DashboardAtWidth : public DashboardInBrowser, public testing::WithParamInterface<int> {};

TEST_P(DashboardAtWidth, IsLegible) {
  browser->resize(GetParam(), 900);
  EXPECT_LE(browser->evaluate("return document.documentElement.scrollWidth"), GetParam()) << "no scrolling sideways";
  const auto smallest = browser->evaluate(
      "return Math.min(...[...document.querySelectorAll('body *')].filter(e => e.getClientRects().length && "
      "[...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) && !['SCRIPT', 'STYLE', "
      "'title'].includes(e.tagName))"
      ".map(e => parseFloat(getComputedStyle(e).fontSize) * (e.ownerSVGElement ? "
      "e.ownerSVGElement.getBoundingClientRect().width"
      " / e.ownerSVGElement.viewBox.baseVal.width : 1)))");
  EXPECT_GE(smallest.get<double>(), 11) << "pixels of the smallest text";
  browser->evaluate("document.querySelector('#search').scrollIntoView()");
  browser->type("#search", "H2 mps 0.02");
  browser->click_beside(".card svg", 0, 0);
  EXPECT_TRUE(browser->shown("#provenance"));
  EXPECT_LE(browser->evaluate("return document.documentElement.scrollWidth"), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Widths, DashboardAtWidth, testing::Values(1280, 400));

}  // namespace
}  // namespace sluice::ci
