#include "ci/from_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "ci/history.h"
#include "reports/synthetic_run.h"
#include "validation/acceptance.h"
#include "validation/manifest.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class FromRunTest : public testing::Test {
 protected:
  FromRunTest() {
    directory = fs::path(testing::TempDir()) /
                (std::string("sluice-from-run-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory);
  }
  ~FromRunTest() override { fs::remove_all(directory); }

  void write(const synthetic::MadeRun& run = {}, const json& changes = json::object()) {
    synthetic::write_run(directory, run);
    json manifest = json::parse(std::ifstream(directory / "run.json"));
    manifest["started"] = "2026-11-25T09:34:08Z";
    manifest["machine"] = "a processor, 2 processors, 8 GiB";
    manifest["facts"] = {{"iterations_mean", 9.5}};
    manifest["cpu_time_s"] = 1700.0;
    manifest.merge_patch(changes);
    write_manifest(directory, manifest);
  }

  std::string error(const Provenance& given = {}) const {
    try {
      results_of_run(directory, given);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  static const Result* find(const std::vector<Result>& results, const std::string& metric, const std::string& of = "") {
    for (const Result& r : results)
      if (r.metric == metric && r.of == of) return &r;
    return nullptr;
  }

  fs::path directory;
};

TEST_F(FromRunTest, AccuracyAndCostOfARun) {
  write({.scale = 1.1});
  const auto results = results_of_run(directory);
  const Result* impulse = find(results, "impulse_deviation", "P1 wall");
  ASSERT_NE(impulse, nullptr);
  EXPECT_NEAR(impulse->value.value(), 0.1, 1e-3);
  EXPECT_NEAR(find(results, "mean_impulse_error")->value.value(), 0.1, 1e-3);
  EXPECT_EQ(find(results, "rmse_over_range", "H2 column")->unit, "1");
  EXPECT_EQ(find(results, "impulse_deviation", "P1 kernel"), nullptr) << "not the primary reading";
  EXPECT_EQ(find(results, "finished")->value, 1);
  EXPECT_EQ(find(results, "lost_through_walls")->value, 0);
  EXPECT_EQ(find(results, "cpu_time_s")->value, 1700);
  EXPECT_EQ(find(results, "particle_steps_per_s")->value, 5.6e6);
  EXPECT_EQ(find(results, "iterations_mean")->value, 9.5);
  EXPECT_EQ(find(results, "phase_time_s", "sort")->value, 100);
  EXPECT_EQ(find(results, "peak_memory_bytes")->unit, "B");
  EXPECT_EQ(impulse->date, "2026-11-25T09:34:08Z");
  EXPECT_EQ(impulse->commit, "0123abcd");
  EXPECT_EQ(impulse->machine, "a processor, 2 processors, 8 GiB");
  EXPECT_EQ(impulse->threads, 2);
  EXPECT_EQ(impulse->link, directory.generic_string());
  EXPECT_EQ(impulse->parameters, (json{{"l0_m", 0.02}, {"walls", "extrapolated"}, {"alpha", 0.01}, {"t_end_s", 6.0}}));
}

TEST_F(FromRunTest, EveryMetricIsKnownAndHasOneResult) {
  write();
  std::set<SeriesKey> keys;
  for (const Result& r : results_of_run(directory)) {
    EXPECT_FALSE(kind_of(r.metric).name.empty()) << r.metric;
    EXPECT_FALSE(r.unit.empty()) << r.metric;
    EXPECT_TRUE(keys.insert(key_of(r)).second) << r.metric << " " << r.of;
  }
}

// Not every run has every metric: one that the ledger did not know would go without an alarm.
TEST(FromRun, EveryMetricOfAcceptanceIsOneOfAccuracyThatAlarms) {
  for (const AcceptanceMetric& metric : acceptance_metrics()) {
    EXPECT_EQ(kind_of(metric.name).name, metric.name);
    EXPECT_EQ(kind_of(metric.name).family, Family::accuracy) << metric.name;
    EXPECT_TRUE(kind_of(metric.name).alarms) << metric.name;
  }
}

// Both windows end within the run; a series of one would hide what the case is accepted by.
TEST_F(FromRunTest, AnAcceptanceRowWithAWindowOfItsOwnIsASeriesOfItsOwn) {
  synthetic::write_force_run(directory, {.scale = 1.1});
  const auto results = results_of_run(directory, {.commit = "v2", .date = "2026-11-25T00:00:00Z", .machine = "m"});
  const Result* whole = find(results, "impulse_deviation", "F_column acceleration");
  const Result* window = find(results, "impulse_deviation", "F_column acceleration 0.3 .. 1.3 s");
  ASSERT_NE(whole, nullptr);
  ASSERT_NE(window, nullptr);
  EXPECT_NEAR(window->value.value(), 0.1, 0.01);
}

TEST_F(FromRunTest, WhatARunSetsOtherwiseThanTheCaseTellsItApart) {
  write({}, {{"parameters", {{"delta", 0.02}}}});
  EXPECT_EQ(results_of_run(directory).front().parameters.value("delta", 0.0), 0.02);
}

TEST_F(FromRunTest, ARunInPartsIsOfOneBuildAndItsCostOfOneNumberOfThreads) {
  const json first{{"commit", "0123abcd"}, {"threads", 1}};
  write({}, {{"legs", {first, {{"commit", "0123abcd"}, {"threads", 2}}}}});
  EXPECT_NE(find(results_of_run(directory), "impulse_deviation", "P1 wall"), nullptr);
  EXPECT_EQ(find(results_of_run(directory), "cpu_time_s"), nullptr);
  write({}, {{"legs", {first, {{"commit", "4567cdef"}, {"threads", 1}}}}});
  EXPECT_THAT(error(), HasSubstr("different commit (0123abcd, then 4567cdef)"));
}

// A wave that never arrives must not vanish from the ledger.
TEST_F(FromRunTest, WhatARunShouldHaveGivenAndDidNotIsRecorded) {
  write({.scale = 0.05});
  const auto results = results_of_run(directory);
  const Result* arrival = find(results, "arrival_difference_s", "P1 wall");
  ASSERT_NE(arrival, nullptr);
  EXPECT_FALSE(arrival->value);
  EXPECT_THAT(arrival->reason, HasSubstr("no simulated arrival"));
}

TEST_F(FromRunTest, ARunThatWasAskedToEndBeforeTheWindowOwesNothingThere) {
  write({.t_end_s = 0.32}, {{"t_end_s", 0.32}});
  for (const Result& r : results_of_run(directory)) EXPECT_TRUE(r.value) << r.metric << " " << r.of;
  write({.t_end_s = 0.32}, {{"t_end_s", 6.0}});
  EXPECT_FALSE(find(results_of_run(directory), "mean_impulse_error")->value);
}

TEST_F(FromRunTest, TheEarlyFlowOfEveryRunThatTellsItsEnergies) {
  write();
  const auto results = results_of_run(directory);
  ASSERT_NE(find(results, "kinetic_energy_share"), nullptr);
  EXPECT_NEAR(find(results, "kinetic_energy_share")->value.value(), 100.0 / 900, 1e-12);
}

TEST_F(FromRunTest, AFailedRunIsNotFinishedAndNothingElse) {
  write({.status = "failed"});
  const auto results = results_of_run(directory);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].metric, "finished");
  EXPECT_EQ(results[0].value, 0);
}

TEST_F(FromRunTest, ARunThatFailedBeforeItBeganIsNotFinishedEither) {
  write({.status = "failed"});
  fs::remove(directory / "probes.csv");
  const auto results = results_of_run(directory);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].value, 0);
}

TEST_F(FromRunTest, ASensorThatIsNoLongerReadIsMissingUnderItsName) {
  write();
  const RunRecord run = read_run(directory);
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  for (const std::string& name : run.probes.names()) {
    if (name.starts_with("H2_")) continue;
    names.push_back(name);
    columns.push_back(run.probes.values(name));
  }
  write_probes(directory / "probes.csv", {directory, names, run.probes.times_s(), columns});
  const auto results = results_of_run(directory);
  const Result* lost = find(results, "rmse_over_range", "H2 column");
  ASSERT_NE(lost, nullptr);
  EXPECT_FALSE(lost->value);
  EXPECT_THAT(lost->reason, HasSubstr("no such column"));
  EXPECT_TRUE(find(results, "rmse_over_range", "H4 column")->value);
}

TEST_F(FromRunTest, ErrorsSayWhatIsMissingAndTheRemedy) {
  EXPECT_THAT(error(), HasSubstr("no such run directory"));
  write({.status = "running"});
  EXPECT_THAT(error(), HasSubstr("sluice resume"));
  write({}, {{"started", nullptr}});
  EXPECT_THAT(error(), HasSubstr("give --date"));
  write({}, {{"started", "yesterday"}});
  EXPECT_THAT(error(), HasSubstr("`yesterday` is no date"));
  write({}, {{"machine", nullptr}});
  EXPECT_EQ(results_of_run(directory).front().machine, "a processor, processors not stated");
}

TEST_F(FromRunTest, AnotherCodesRunNeedsWhatItsFileDoesNotSay) {
  synthetic::write_external_run(directory, 1.2);
  EXPECT_THAT(error(), HasSubstr("give --commit"));
  const auto results = results_of_run(directory, {.commit = "v2", .date = "2026-11-25T00:00:00Z", .machine = "m"});
  const Result* impulse = find(results, "impulse_deviation", "P1");
  ASSERT_NE(impulse, nullptr);
  EXPECT_NEAR(impulse->value.value(), 0.2, 1e-3);
  EXPECT_EQ(impulse->commit, "v2");
  EXPECT_EQ(find(results, "cpu_time_s"), nullptr);
  EXPECT_EQ(find(results, "finished"), nullptr);
}

// Its three lines of run.json are the same every night.
TEST_F(FromRunTest, EveryNightOfAnotherCodeIsARunOfItsOwn) {
  const auto name = [&](const std::string& commit, const std::string& date) {
    return results_of_run(directory, {.commit = commit, .date = date, .machine = "m"}).front().run;
  };
  synthetic::write_external_run(directory, 1.2);
  const std::string first = name("v2", "2026-11-25T00:00:00Z");
  EXPECT_EQ(name("v2", "2026-11-25T00:00:00Z"), first);
  EXPECT_NE(name("v3", "2026-11-25T00:00:00Z"), first);
  EXPECT_NE(name("v2", "2026-11-26T00:00:00Z"), first);
  synthetic::write_external_run(directory, 1.3);
  EXPECT_NE(name("v2", "2026-11-25T00:00:00Z"), first);
}

TEST_F(FromRunTest, ARunHasItsOwnName) {
  write();
  const std::string once = results_of_run(directory).front().run;
  EXPECT_EQ(results_of_run(directory).front().run, once);
  write({}, {{"started", "2026-11-26T09:34:08Z"}});
  EXPECT_NE(results_of_run(directory).front().run, once);
}

}  // namespace
}  // namespace sluice::ci
