#include "validation/begin_anew.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "validation/campaign_folder.h"
#include "validation/fake_solver.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class BeginAnew : public CampaignFolder {
 protected:
  BeginAnew()
      : campaign(
            load("name = \"c\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\nt_end_s = 0.01\n")),
        run(campaign.runs.at(0)),
        kept(run.directory.parent_path() / "outdated" / run.directory.filename()),
        told(directory / "told.txt") {
    options.available_memory_bytes = std::int64_t{1} << 40;
    options.factory = [this](const Case&, const Scene& scene, const RunSettings&) {
      if (refused) throw std::invalid_argument("out of its range");
      auto solver = std::make_unique<FakeSolver>(scene, 4e-4);
      if (fails) solver->before_step = [](FakeSolver&) { throw std::runtime_error("out of luck"); };
      return solver;
    };
  }

  std::string begin() {
    std::FILE* file = std::fopen(told.c_str(), "w");
    options.progress = file;
    status = begin_anew(campaign, run, options).status;
    std::fclose(file);
    options.progress = nullptr;
    std::ifstream in(told);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Campaign campaign;
  const CampaignRun& run;
  fs::path kept;
  fs::path told;
  RunOptions options;
  bool fails = false;
  bool refused = false;
  std::string status;
};

TEST_F(BeginAnew, AFinishedRunIsSetAside) {
  begin();
  EXPECT_EQ(status, "finished");
  EXPECT_FALSE(fs::exists(kept)) << "there was nothing before";
  EXPECT_THAT(begin(), AllOf(HasSubstr("finished before: kept as " + kept.string() + " (1 run and "),
                             HasSubstr("B there by now)")));
  EXPECT_THAT(begin(), HasSubstr("-2 (2 runs and "));
  EXPECT_EQ(read_run(kept).status(), "finished");
  EXPECT_EQ(read_run(run.directory).status(), "finished");
}

TEST_F(BeginAnew, AFailedRunIsSetAsideWhereItHasRows) {
  fails = true;
  begin();
  ASSERT_EQ(state_of(campaign, run), CampaignState::incomplete);
  fails = false;
  EXPECT_THAT(begin(), HasSubstr("unfinished, and without a checkpoint: kept as " + kept.string()));
  EXPECT_EQ(read_run(kept).text("error"), "out of luck");
  EXPECT_EQ(read_run(kept).snapshots().size(), 1U) << "the state it failed at";
  EXPECT_EQ(status, "finished");
}

TEST_F(BeginAnew, ARunThatFailedBeforeItsFirstRowIsReplaced) {
  refused = true;
  begin();
  ASSERT_EQ(status, "failed");
  refused = false;
  begin();
  EXPECT_EQ(status, "finished");
  EXPECT_FALSE(fs::exists(kept));
}

TEST_F(BeginAnew, WhereTheNewRunIsRefusedTheOldOneStays) {
  begin();
  options.available_memory_bytes = 1;
  EXPECT_THROW(begin_anew(campaign, run, options), std::runtime_error);
  EXPECT_EQ(state_of(campaign, run), CampaignState::finished);
  EXPECT_FALSE(fs::exists(kept));
}

}  // namespace
}  // namespace sluice
