// What tests of campaigns share: a folder with a campaign's file and run directories as runs leave them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "validation/campaign.h"
#include "validation/manifest.h"

namespace sluice {

class CampaignFolder : public testing::Test {
 protected:
  CampaignFolder() {
    directory = std::filesystem::temp_directory_path() /
                (std::string("sluice-campaign-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
    file = directory / "c.toml";
  }
  ~CampaignFolder() override { std::filesystem::remove_all(directory); }

  Campaign load(const std::string& text) const {
    std::ofstream(file) << text;
    return load_campaign(file, directory / "runs", 1);
  }
  std::string refusal(const std::string& text) const {
    try {
      load(text);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "accepted";
  }
  /// A manifest as a run of this campaign leaves it.
  static nlohmann::json manifest(const Campaign& campaign, const CampaignRun& run, const std::string& status) {
    const RunSettings& s = run.settings;
    return {{"case_hash", campaign.case_of(run).hash},
            {"solver", s.solver},
            {"walls", s.walls},
            {"l0_m", s.l0_m},
            {"t_end_s", s.t_end_s},
            {"output_rate_Hz", s.output_rate_Hz},
            {"parameters", s.parameters},
            {"threads", s.threads},
            {"machine", machine_fingerprint()},
            {"status", status}};
  }
  static void put(const CampaignRun& run, const nlohmann::json& manifest) {
    std::filesystem::create_directories(run.directory);
    std::ofstream(run.directory / "run.json") << manifest;
  }

  std::filesystem::path directory;
  std::filesystem::path file;
};

inline const char* const two_groups = R"(name = "two"
[[runs]]
case = "kleefsman"
solver = "wcsph"
walls = ["extrapolated", "dynamic"]
l0_m = [0.05, 0.04]
alpha = [0.1, 0.01]
t_end_s = 2.0
[[runs]]
case = "kleefsman"
solver = "mps"
l0_m = [0.05]
parameters = { restitution = 0.5 }
)";

}  // namespace sluice
