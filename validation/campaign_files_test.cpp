// The campaigns of the project.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "validation/campaign.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// What the paper's Tables 1 and 3 list, no more and no less.
TEST(PaperCampaign, IsThePapersMatrix) {
  const Campaign campaign = load_campaign("validation/campaigns/paper.toml", "runs", 1);
  std::vector<std::string> ours;
  for (const CampaignRun& run : campaign.runs) {
    const auto alpha = run.settings.parameters.find("alpha");
    ours.push_back(fmt::format("{} {} {:g} {:g} to {:g} s", campaign.case_of(run).name, run.settings.solver,
                               run.settings.l0_m, alpha == run.settings.parameters.end() ? 0 : alpha->second,
                               run.settings.t_end_s));
  }
  std::vector<std::string> papers;
  for (const Case& c : campaign.cases)
    for (const PublishedRun& run : c.published.runs)
      for (const double alpha : run.alpha.empty() ? std::vector<double>{0} : run.alpha)
        papers.push_back(fmt::format("{} {} {:g} {:g} to {:g} s", c.name, run.solver, run.l0_m, alpha, run.t_end_s));
  EXPECT_THAT(ours, testing::UnorderedElementsAreArray(papers));
  EXPECT_EQ(ours.size(), 13U);
}

TEST(CampaignFiles, AllOfThemCanBeRead) {
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator("validation/campaigns")) {
    const Campaign campaign = load_campaign(entry.path(), "runs", 1);
    EXPECT_EQ(campaign.name, entry.path().stem());
    EXPECT_FALSE(campaign.runs.empty()) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 6);
}

TEST(PaperCampaign, IsComputedThePapersWay) {
  for (const CampaignRun& run : load_campaign("validation/campaigns/paper.toml", "runs", 1).runs) {
    const bool mps = run.settings.solver == "mps";
    EXPECT_EQ(run.settings.walls, mps ? "dummies" : "dynamic");
    EXPECT_FALSE(run.settings.snapshot_times_s.empty());
    if (mps) {
      EXPECT_GE(run.settings.parameters.at("tolerated_crowding"), 100) << "the source of Eq. (23) alone";
    } else {
      EXPECT_EQ(run.settings.parameters.at("restart_interval"), 40);
      EXPECT_EQ(run.settings.parameters.at("tension_limit"), 1);
    }
  }
}

}  // namespace
}  // namespace sluice
