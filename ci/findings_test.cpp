#include "ci/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ci/made_results.h"
#include "ci/summary.h"

namespace sluice::ci {
namespace {

using made::result;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A quiet series with steps: value[i] holds from night `from[i]` on.
Ledger steps(const std::string& metric, std::initializer_list<std::pair<int, double>> levels, int nights,
             const std::string& unit = "1") {
  Ledger ledger;
  for (int k = 0; k < nights; ++k) {
    double value = 0;
    for (const auto& [from, level] : levels)
      if (k >= from) value = level;
    ledger.results.push_back(result(k, metric, "P1 wall", value, unit));
  }
  return ledger;
}

std::vector<Finding> findings(const Ledger& ledger) {
  std::vector<Finding> all;
  for (const SeriesFindings& found : find_all(ledger))
    all.insert(all.end(), found.findings.begin(), found.findings.end());
  return all;
}

Acceptance acceptance_of(const Ledger& ledger, const Finding& finding, bool scatter = false) {
  const std::string id = find_all(ledger).front().series.key.id();
  return {made::night(100),
          "me",
          id,
          finding.first->date,
          finding.first->commit,
          finding.shift.after - finding.shift.before,
          "why",
          scatter};
}

TEST(Findings, ADeviationIsWorseAwayFromZeroOnEitherSide) {
  EXPECT_EQ(findings(steps("impulse_deviation", {{0, 0.03}, {10, 0.06}}, 12))[0].verdict, Verdict::worse);
  EXPECT_EQ(findings(steps("impulse_deviation", {{0, -0.03}, {10, -0.06}}, 12))[0].verdict, Verdict::worse);
  EXPECT_EQ(findings(steps("impulse_deviation", {{0, -0.06}, {10, -0.03}}, 12))[0].verdict, Verdict::better);
  EXPECT_EQ(findings(steps("impulse_deviation", {{0, -0.03}, {10, 0.032}}, 12))[0].verdict, Verdict::moved);
  EXPECT_EQ(findings(steps("impulse_deviation", {{0, -0.03}, {10, 0.08}}, 12))[0].verdict, Verdict::worse);
  EXPECT_TRUE(findings(steps("impulse_deviation", {{0, 0.03}, {10, 0.035}}, 12)).empty()) << "too small to matter";
}

TEST(Findings, CostsKnowTheirDirection) {
  EXPECT_EQ(findings(steps("steps", {{0, 1000}, {10, 1100}}, 12))[0].verdict, Verdict::worse);
  EXPECT_EQ(findings(steps("steps", {{0, 1000}, {10, 900}}, 12))[0].verdict, Verdict::better);
  EXPECT_EQ(findings(steps("finished", {{0, 1}, {10, 0}}, 12))[0].verdict, Verdict::worse);
}

TEST(Findings, AValueThatIsToStayAlarmsBothWaysUntilItIsBack) {
  for (const double moved : {0.0999, 0.1001}) {
    const auto open = findings(steps("compression", {{0, 0.1}, {10, moved}}, 12));
    ASSERT_EQ(open.size(), 1u) << moved;
    EXPECT_EQ(open[0].verdict, Verdict::moved) << moved;
    EXPECT_EQ(open[0].state, State::open) << moved;
    const auto back = findings(steps("compression", {{0, 0.1}, {10, moved}, {13, 0.1}}, 18));
    ASSERT_EQ(back.size(), 2u) << moved;
    EXPECT_EQ(back[0].state, State::fixed) << moved;
  }
  EXPECT_TRUE(findings(steps("compression", {{0, 0.1}, {10, 0.10001}}, 12)).empty()) << "rounding";
}

TEST(Findings, WorseIsOpenUntilAcceptedOrMended) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.03}, {10, 0.06}}, 12);
  const auto open = findings(ledger);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].state, State::open);
  EXPECT_EQ(open[0].last_before->commit, "c009");
  EXPECT_EQ(open[0].first->commit, "c010");
  ledger.acceptances.push_back(acceptance_of(ledger, open[0]));
  const auto accepted = findings(ledger);
  EXPECT_EQ(accepted[0].state, State::accepted);
  EXPECT_EQ(accepted[0].acceptance->reason, "why");

  const auto mended = findings(steps("impulse_deviation", {{0, 0.03}, {10, 0.06}, {14, 0.032}}, 16));
  ASSERT_EQ(mended.size(), 2u);
  EXPECT_EQ(mended[0].state, State::fixed);
  EXPECT_EQ(mended[1].state, State::note);
}

// The commit that is named must be the one that made it worse this time.
TEST(Findings, WhatWasMendedStaysMendedWhenSomethingElseMakesItWorse) {
  const auto all = findings(steps("impulse_deviation", {{0, 0.03}, {10, 0.06}, {14, 0.032}, {20, 0.06}}, 24));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].state, State::fixed);
  EXPECT_EQ(all[2].verdict, Verdict::worse);
  EXPECT_EQ(all[2].state, State::open);
}

TEST(Findings, AnAcceptedShiftIsTheNewBase) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.03}, {10, 0.06}, {20, 0.09}}, 22);
  ledger.acceptances.push_back(acceptance_of(ledger, findings(ledger)[0]));
  const auto all = findings(ledger);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].state, State::accepted);
  EXPECT_EQ(all[1].state, State::open);
}

TEST(Findings, AnImprovementThatIsLostAgainIsARegression) {
  const auto all = findings(steps("impulse_deviation", {{0, 0.08}, {10, 0.03}, {20, 0.08}}, 22));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].verdict, Verdict::better);
  EXPECT_EQ(all[1].state, State::open);
}

TEST(Findings, AShiftAcceptedAsScatterWidensWhatIsTolerated) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.03}, {10, 0.045}, {20, 0.065}}, 22);
  ASSERT_EQ(findings(ledger).size(), 2u);
  ledger.acceptances.push_back(acceptance_of(ledger, findings(ledger)[0], true));
  EXPECT_TRUE(findings(ledger).empty()) << "both are below three times the accepted 0.015";
  // A series of several levels is not quiet: a new one must be confirmed.
  for (int k = 22; k < 26; ++k) ledger.results.push_back(result(k, "impulse_deviation", "P1 wall", 0.2));
  EXPECT_EQ(findings(ledger).size(), 1u);
}

TEST(Findings, AValueThatNoLongerComesIsOpen) {
  Ledger ledger = steps("arrival_difference_s", {{0, 0.01}}, 10, "s");
  ledger.results.back().value.reset();
  ledger.results.back().reason = "no simulated arrival";
  const auto all = findings(ledger);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].verdict, Verdict::missing);
  EXPECT_EQ(all[0].state, State::open);
  EXPECT_THAT(summary(find_all(ledger)),
              AllOf(HasSubstr("MISSING"), HasSubstr("no simulated arrival"), HasSubstr("c009")));
  ledger.results.push_back(result(10, "arrival_difference_s", "P1 wall", 0.01, "s"));
  EXPECT_TRUE(findings(ledger).empty()) << "it came back";
}

// As of another code, of which nobody knows what it owes: the column is not there, and no line of the ledger says so.
TEST(Findings, AValueThatIsNotEvenWrittenAnyMoreIsOpen) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.01}}, 10);
  for (int k = 0; k < 12; ++k) ledger.results.push_back(result(k, "impulse_deviation", "P2 wall", 0.02));
  ledger.results.push_back(result(12, "finished", "", 0));  // a run that failed owes nothing
  std::vector<SeriesFindings> all = find_all(ledger);
  ASSERT_EQ(all.size(), 3u) << "finished, P1, P2";
  ASSERT_EQ(all[1].findings.size(), 1u);
  const Finding& missing = all[1].findings[0];
  EXPECT_EQ(missing.verdict, Verdict::missing);
  EXPECT_EQ(missing.state, State::open);
  EXPECT_EQ(missing.first->commit, "c010");
  EXPECT_EQ(count(all).open, 1u);
  EXPECT_THAT(summary(all), AllOf(HasSubstr("impulse_deviation of P1 wall: +1.00 % to no value"),
                                  HasSubstr("the run gives no such value any more")));
  Acceptance known = acceptance_of(ledger, missing);
  known.series = all[1].series.key.id();
  ledger.acceptances.push_back(known);
  all = find_all(ledger);
  EXPECT_EQ(all[1].findings.at(0).state, State::accepted);
  ledger.results.push_back(result(13, "impulse_deviation", "P1 wall", 0.01));
  ledger.results.push_back(result(13, "impulse_deviation", "P2 wall", 0.02));
  EXPECT_TRUE(findings(ledger).empty()) << "it came back";
}

// What is measured for the first time is not missing before.
TEST(Findings, ANewSensorIsNotMissingInOlderRuns) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.01}}, 10);
  for (int k = 5; k < 10; ++k) ledger.results.push_back(result(k, "impulse_deviation", "P2 wall", 0.02));
  for (const SeriesFindings& found : find_all(ledger)) {
    EXPECT_TRUE(found.findings.empty());
    EXPECT_TRUE(found.series.absent.empty());
  }
}

TEST(Findings, OfAMetricWithoutAlarmIsANote) {
  Ledger ledger;
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  for (int k = 0; k < 60; ++k)
    ledger.results.push_back(result(k, "phase_time_s", "sort", (k < 50 ? 1 : 2) + noise(random), "s"));
  const auto all = findings(ledger);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].verdict, Verdict::worse);
  EXPECT_EQ(all[0].state, State::note);
}

// Another machine's times are another series; its accuracy is not.
TEST(Findings, TimesOfTwoMachinesAreNotCompared) {
  Ledger ledger;
  for (int k = 0; k < 40; ++k) {
    for (const char* metric : {"wall_time_s", "rmse_over_range"}) {
      Result r = result(k, metric, "", std::string(metric) == "wall_time_s" ? (k < 35 ? 100 : 300) : 0.05, "s");
      if (k >= 35) r.machine = "a slow one";
      ledger.results.push_back(r);
    }
  }
  const auto all = find_all(ledger);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(count(all).open, 0u);
  Ledger threads = ledger;
  for (Result& r : threads.results) r.threads = r.date < made::night(10) ? 1 : 2;
  EXPECT_EQ(find_all(threads).size(), 4u);
}

TEST(Findings, PointsAreOrderedByDateNotByArrival) {
  Ledger ledger = steps("steps", {{0, 1000}, {10, 1100}}, 12);
  std::reverse(ledger.results.begin(), ledger.results.end());
  const auto all = findings(ledger);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].first->commit, "c010");
}

TEST(Findings, ASeriesThatIsNoLongerRunIsNamed) {
  Ledger ledger = steps("steps", {{0, 1000}}, 10);
  ledger.results.push_back(result(30, "iterations_mean", "", 9));
  const auto all = find_all(ledger);
  EXPECT_EQ(count(all).stale, 1u);
  EXPECT_THAT(summary(all), HasSubstr("not seen since 2026-01-10"));
}

TEST(Summary, SaysWhatSinceWhenHowMuchAndWhere) {
  Ledger ledger = steps("impulse_deviation", {{0, 0.03}, {10, 0.06}}, 12);
  for (Result& r : ledger.results)
    if (r.date >= made::night(10)) r.compiler = "g++ 13.1.0";
  const std::string text = summary(find_all(ledger));
  EXPECT_THAT(text, AllOf(HasSubstr("1 open regression"), HasSubstr("kleefsman wcsph, l0_m 0.02, walls extrapolated"),
                          HasSubstr("since c010 (2026-01-11); last good c009 (2026-01-10)"), HasSubstr("WORSE"),
                          HasSubstr("impulse_deviation of P1 wall: +3.00 % to +6.00 %"), HasSubstr("+3.00 points"),
                          HasSubstr("`g++ 12.2.0` before, `g++ 13.1.0` now"),
                          HasSubstr("before runs/nightly/009, after runs/nightly/010")));
  EXPECT_THAT(text, AllOf(HasSubstr("ledger accept"), HasSubstr("series " + find_all(ledger)[0].series.key.id())));
}

TEST(Summary, IsShortWhenAllIsWell) {
  const Ledger ledger = steps("impulse_deviation", {{0, 0.06}, {10, 0.03}}, 12);
  EXPECT_THAT(summary(find_all(ledger)), AllOf(HasSubstr("no open regression in 1 series"), Not(HasSubstr("BETTER"))));
  EXPECT_THAT(summary(find_all(ledger), true), HasSubstr("BETTER"));
  EXPECT_THAT(summary(find_all(Ledger{})), HasSubstr("no open regression in 0 series"));
}

TEST(Findings, OfTheExample) {
  const Ledger ledger = made::example();
  const auto all = find_all(ledger);
  const Count n = count(all);
  EXPECT_EQ(n.accepted, 2u);
  EXPECT_GE(n.open, 7u) << "MPS: P1, mean error at both resolutions, P2, and H2 missing";
  EXPECT_GE(n.better, 2u) << "WCSPH became faster";
}

}  // namespace
}  // namespace sluice::ci
