#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "validation/campaign.h"
#include "validation/campaign_folder.h"
#include "validation/checkpoint.h"
#include "validation/fake_solver.h"
#include "validation/rate_probe.h"
#include "validation/run_checkpoint.h"
#include "validation/run_lock.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CampaignStateTest : public CampaignFolder {
 protected:
  static void put_checkpoint(const CampaignRun& run, double last_t_s) {
    FakeSolver solver(Scene{}, 1e-3);
    RunHeader header;
    header.settings = run.settings;
    header.point.probes.last_t_s = last_t_s;
    write_checkpoint(run.directory / checkpoint_file, to_json(header), solver);
  }
  /// Particles of fluid that a step of WCSPH takes as long for.
  static double work(const ParticleCounts& n) {
    return static_cast<double>(n.fluid) + 0.4 * static_cast<double>(n.solid);
  }
};

TEST_F(CampaignStateTest, AManifestOfAnyShapeHasAState) {
  const Campaign c = load(two_groups);
  for (const char* text : {"[1]", "{\"status\": 5}", "{", ""}) {
    fs::create_directories(c.runs[0].directory);
    std::ofstream(c.runs[0].directory / "run.json") << text;
    EXPECT_EQ(state_of(c, c.runs[0]), CampaignState::outdated) << text;
    EXPECT_NE(estimate(c, c.runs[1], known_costs(c, {})).plan.basis, PlanBasis::run) << text;
  }
}

TEST_F(CampaignStateTest, StatesFollowInputs) {
  const Campaign c = load(two_groups);
  const CampaignRun& run = c.runs[0];
  EXPECT_EQ(state_of(c, run), CampaignState::absent);
  put(run, manifest(c, run, "finished"));
  EXPECT_EQ(state_of(c, run), CampaignState::finished);
  put(run, manifest(c, run, "running"));
  EXPECT_EQ(state_of(c, run), CampaignState::incomplete);
  std::ofstream(run.directory / checkpoint_file) << "something";
  EXPECT_EQ(state_of(c, run), CampaignState::resumable);
  auto other = manifest(c, run, "finished");
  other["parameters"]["delta"] = 0.05;
  put(run, other);
  EXPECT_EQ(state_of(c, run), CampaignState::outdated);
  EXPECT_EQ(why_outdated(c, run), "not as in its run.json: parameters");
  EXPECT_FALSE(can_be_reported(c, run));
}

TEST_F(CampaignStateTest, WordsAndBandsOfTheCaseMakeNoRunOutdated) {
  const Campaign c = load(two_groups);
  const CampaignRun& run = c.runs[0];
  auto done = manifest(c, run, "finished");
  done["case_hash"] = "of the file before a comment";
  put(run, done);
  EXPECT_EQ(why_outdated(c, run), "not as in its run.json: case_hash") << "an older manifest";
  done["computed_hash"] = c.case_of(run).computed_hash;
  put(run, done);
  EXPECT_EQ(state_of(c, run), CampaignState::finished);
  EXPECT_TRUE(can_be_reported(c, run));
  done["computed_hash"] = "of other sensors";
  put(run, done);
  EXPECT_EQ(why_outdated(c, run), "not as in its run.json: computed_hash");
}

TEST_F(CampaignStateTest, ARunWithoutTheSnapshotsAskedForIsOutdated) {
  const Campaign campaign =
      load("name = \"c\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\nsnapshots = true\n");
  const CampaignRun& run = campaign.runs.at(0);
  put(run, manifest(campaign, run, "finished"));
  EXPECT_EQ(state_of(campaign, run), CampaignState::outdated);
  EXPECT_EQ(why_outdated(campaign, run), "without the snapshots asked for");
  EXPECT_TRUE(can_be_reported(campaign, run)) << "its series are what the report is of";
  std::ofstream(run.directory / "snapshots.pvd") << "\n";
  EXPECT_EQ(state_of(campaign, run), CampaignState::finished);
  auto begun = manifest(campaign, run, "interrupted");
  begun["snapshot_times_s"] = run.settings.snapshot_times_s;
  put(run, begun);
  std::ofstream(run.directory / checkpoint_file) << "something";
  EXPECT_EQ(state_of(campaign, run), CampaignState::resumable);
  begun["snapshot_times_s"] = nlohmann::json::array();
  put(run, begun);
  EXPECT_EQ(state_of(campaign, run), CampaignState::outdated) << "going on would not make them";
}

TEST_F(CampaignStateTest, AnOutdatedRunIsSetAsideWhole) {
  const Campaign campaign = load(two_groups);
  const CampaignRun& run = campaign.runs.at(0);
  for (const std::string suffix : {"", "-2", "-3"}) {
    put(run, manifest(campaign, run, "interrupted"));
    std::ofstream(run.directory / checkpoint_file) << "hours of work" << suffix;
    const fs::path place = set_aside(run.directory);
    EXPECT_EQ(place.filename().string(), run.directory.filename().string() + suffix);
    EXPECT_EQ(place.parent_path(), run.directory.parent_path() / "outdated");
    std::ifstream checkpoint(place / checkpoint_file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(checkpoint), {}), "hours of work" + suffix);
    EXPECT_EQ(state_of(campaign, run), CampaignState::absent);
  }
  put(run, manifest(campaign, run, "interrupted"));
  const RunLock held(run.directory);
  EXPECT_THAT([&] { set_aside(run.directory); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("computes here")));
}

TEST_F(CampaignStateTest, TimesAreScaledFromTheNearestFinishedRunOfItsKind) {
  const Campaign c = load(two_groups);
  const CampaignRun& coarse = c.runs[0];
  const CampaignRun& fine = c.runs[2];
  EXPECT_NE(estimate(c, fine, known_costs(c, {})).plan.basis, PlanBasis::run);
  auto done = manifest(c, coarse, "finished");
  done["wall_time_s"] = 10.0;
  done["steps"] = 1000;
  done["time_s"] = 2.0;
  done["particles"] = {{"fluid", 5000}, {"solid", 9000}};
  put(coarse, done);
  const CampaignEstimate e = estimate(c, fine, known_costs(c, {}));
  EXPECT_EQ(e.plan.basis, PlanBasis::run);
  EXPECT_NEAR(e.plan.steps, 1250, 1e-6);
  EXPECT_NEAR(e.plan.wall_time_s, 10.0 * 1.25 * work(e.plan.particles) / work({5000, 9000}), 1e-6);
  EXPECT_NE(estimate(c, c.runs[4], known_costs(c, {})).plan.basis, PlanBasis::run) << "other walls";
  auto part = manifest(c, fine, "running");
  part["time_s"] = 1.9;  // where it was killed; it goes on from its checkpoint
  put(fine, part);
  put_checkpoint(fine, 1.5);
  EXPECT_NEAR(estimate(c, fine, known_costs(c, {})).remaining_s(), 0.25 * e.plan.wall_time_s, 1e-6);
  EXPECT_EQ(estimate(c, fine, known_costs(c, {}), true).done_share, 0) << "computed anew";
  std::ofstream(fine.directory / checkpoint_file) << "something";
  EXPECT_EQ(estimate(c, fine, known_costs(c, {})).done_share, 0) << "what cannot be read";
}

TEST_F(CampaignStateTest, ARunBesideTheCampaignTellsTheRateOfItsKind) {
  const Campaign c = load(two_groups);
  const CampaignRun& fine = c.runs[2];
  const fs::path beside = directory / "elsewhere" / "older";
  auto done = manifest(c, fine, "finished");
  done["wall_time_s"] = 10.0;
  done["steps"] = 1000;
  done["time_s"] = 2.0;
  done["particles"] = {{"fluid", 5000}, {"solid", 9000}};
  const auto plan_beside = [&] {
    fs::create_directories(beside);
    std::ofstream(beside / "run.json") << done;
    const auto others = runs_near(directory / "runs");
    EXPECT_EQ(others, (std::vector<fs::path>{beside}));
    return estimate(c, fine, known_costs(c, others)).plan;
  };
  const Plan constants = plan_run(c.case_of(fine), fine.settings);
  const double loads = work(constants.particles) / work({5000, 9000});
  EXPECT_NEAR(plan_beside().wall_time_s, loads * 10.0 * fine.settings.t_end_s / 2.0, 1e-6);
  done["case_hash"] = "another";  // its rate counts, its time step does not
  EXPECT_NEAR(plan_beside().wall_time_s, loads * 10.0 * constants.steps / 1000, 1e-6);
  done["machine"] = "another";
  EXPECT_NE(plan_beside().basis, PlanBasis::run);
}

TEST_F(CampaignStateTest, WhereNothingHasRunYetTheFirstStepsTellTheRate) {
  const std::string group = "name = \"p\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"wcsph\"\nl0_m = [0.05, 0.04]\n";
  EXPECT_TRUE(probe_costs(load(group + "t_end_s = 0.1\n"), false, {}).empty()) << "too short to be worth it";
  const Campaign c = load(group + "t_end_s = 600\n");
  const std::vector<RunCost> probed = probe_costs(c, false, {});
  ASSERT_EQ(probed.size(), 2U) << "one for each particle distance";
  EXPECT_GE(probed[0].steps, 5);
  const double rate = probed[1].fluid * probed[1].steps / probed[1].wall_time_s;
  const Plan constants = plan_run(c.case_of(c.runs[1]), c.runs[1].settings);
  const Plan plan = estimate(c, c.runs[1], probed).plan;
  EXPECT_EQ(plan.basis, PlanBasis::probe);
  EXPECT_EQ(plan.steps, constants.steps);
  EXPECT_NEAR(plan.wall_time_s, static_cast<double>(plan.particles.fluid) * plan.steps / rate, 1e-6 * plan.wall_time_s);
  RunCost run = probed[0];
  run.probed = false;
  EXPECT_TRUE(probe_costs(c, false, {run}).empty());
  run.l0_m = 0.01;
  EXPECT_EQ(estimate(c, c.runs[1], {probed[0], run}).plan.basis, PlanBasis::run) << "farther, but a run";
  run.case_hash = "another";
  EXPECT_EQ(estimate(c, c.runs[1], {probed[0], run}).plan.basis, PlanBasis::probe);
}

TEST_F(CampaignStateTest, ARunByItselfIsPlannedByItsFirstStepsToo) {
  const std::string text = "name = \"p\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\nt_end_s = ";
  const auto planned = [&](const Campaign& c) {
    return probed_plan(c.case_of(c.runs[0]), c.runs[0].settings, c.runs[0].directory);
  };
  EXPECT_EQ(planned(load(text + "0.1\n")).basis, PlanBasis::constants) << "too short to be worth it";
  const Campaign c = load(text + "600\n");
  EXPECT_EQ(planned(c).basis, PlanBasis::probe);
  EXPECT_THAT(describe(planned(c), std::nullopt), HasSubstr("by a second of its first steps"));
  auto done = manifest(c, c.runs[0], "finished");
  done["wall_time_s"] = 10.0;
  done["steps"] = 1000;
  done["time_s"] = 2.0;
  done["particles"] = {{"fluid", 5000}, {"solid", 9000}};
  fs::create_directories(c.runs[0].directory);
  std::ofstream(c.runs[0].directory / "run.json") << done;
  EXPECT_EQ(planned(c).basis, PlanBasis::run);
}

TEST_F(CampaignStateTest, FirstStepsThatFailAreNoReasonToStopTheOthers) {
  const std::string group = "[[runs]]\ncase = \"kleefsman\"\nsolver = \"wcsph\"\nl0_m = [0.05]\nt_end_s = 600\n";
  const Campaign c = load("name = \"p\"\n" + group + "parameters = { speed_of_sound_m_s = 1e-3 }\n" + group +
                          "walls = [\"dynamic\"]\n");
  EXPECT_ANY_THROW(probe_cost(c.case_of(c.runs[0]), c.runs[0].settings));
  const std::vector<RunCost> probed = probe_costs(c, false, {});
  ASSERT_EQ(probed.size(), 1U);
  EXPECT_EQ(probed[0].walls, "dynamic");
}

/// Alpha moves the time step, in thin layers by a third from 0.1 to 0.001.
TEST_F(CampaignStateTest, OfTwoRunsTheOneOfTheNearestAlphaCounts) {
  const Campaign c = load(
      "name = \"c\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"wcsph\"\nl0_m = [0.05]\nalpha = [0.1, 0.01, 0.001]\n");
  for (const std::size_t k : {0, 2}) {
    auto done = manifest(c, c.runs[k], "finished");
    done["wall_time_s"] = 10.0;
    done["steps"] = k == 0 ? 1000 : 1400;
    done["time_s"] = c.runs[k].settings.t_end_s;
    done["particles"] = {{"fluid", 5000}, {"solid", 9000}};
    put(c.runs[k], done);
  }
  CampaignRun run = c.runs[1];
  run.settings.parameters["alpha"] = 0.04;
  EXPECT_NEAR(estimate(c, run, known_costs(c, {})).plan.steps, 1000, 1e-6);
  run.settings.parameters["alpha"] = 0.004;
  EXPECT_NEAR(estimate(c, run, known_costs(c, {})).plan.steps, 1400, 1e-6);
}

TEST_F(CampaignStateTest, OfTwoRunsTheOneOfTheSameParametersCounts) {
  const Campaign c = load(two_groups);
  const CampaignRun& run = c.runs[0];
  auto done = manifest(c, run, "finished");
  done["wall_time_s"] = 10.0;
  done["steps"] = 1000;
  done["time_s"] = run.settings.t_end_s;
  done["particles"] = {{"fluid", 5000}, {"solid", 9000}};
  const std::vector<fs::path> others{directory / "a", directory / "b"};
  for (const fs::path& other : others) fs::create_directories(other);
  std::ofstream(others[1] / "run.json") << done;
  const double planned_s = estimate(c, run, known_costs(c, others)).plan.wall_time_s;
  done["parameters"]["courant"] = 0.02;
  done["steps"] = 10'000;
  done["wall_time_s"] = 300.0;
  std::ofstream(others[0] / "run.json") << done;
  EXPECT_EQ(estimate(c, run, known_costs(c, others)).plan.wall_time_s, planned_s);
}

}  // namespace
}  // namespace sluice
