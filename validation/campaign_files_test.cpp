// The campaigns of the project.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "solvers/scene.h"
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

/// An order needs one flow: what its particle distances were chosen for.
TEST(ConvergenceCampaign, ComputesOneFlow) {
  std::map<std::string, std::vector<double>> lengths_m;
  const Campaign campaign = load_campaign("validation/campaigns/convergence.toml", "runs", 1);
  for (const CampaignRun& run : campaign.runs) {
    const Scene scene = build_scene(scene_description(campaign.case_of(run), run.settings.l0_m, 1));
    const Box& water = scene.fitted.fluid.at(0);
    const Box& box = scene.fitted.obstacles.at(0).box;
    for (const auto& [name, from, to] : {std::tuple("water", water.lower, water.upper), {"box", box.lower, box.upper}})
      for (int axis = 0; axis < 3; ++axis)
        lengths_m[fmt::format("{} {}", name, axis)].push_back(component(to - from, axis));
    lengths_m["way"].push_back(water.lower.x - box.upper.x);
    lengths_m["room behind"].push_back(box.lower.x - scene.fitted.tank.lower.x);
  }
  for (const auto& [name, all] : lengths_m) {
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    EXPECT_LE(*most, 1.01 * *least) << name;
  }
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
