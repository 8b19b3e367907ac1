#include "validation/campaign.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "validation/campaign_folder.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

using CampaignTest = CampaignFolder;

TEST_F(CampaignTest, IsEveryCombination) {
  const Campaign c = load(two_groups);
  EXPECT_EQ(c.name, "two");
  EXPECT_EQ(c.cases.size(), 1U);
  ASSERT_EQ(c.runs.size(), 9U);
  EXPECT_EQ(c.runs[0].directory.filename(), "kleefsman-wcsph-extrapolated-l0.050-alpha0.1-t_end_s2");
  EXPECT_EQ(c.runs[3].settings.l0_m, 0.04);
  EXPECT_EQ(c.runs[3].settings.parameters.at("alpha"), 0.01);
  EXPECT_EQ(c.runs[4].settings.walls, "dynamic");
  EXPECT_EQ(c.runs[4].settings.t_end_s, 2.0);
  EXPECT_EQ(c.runs[8].settings.solver, "mps");
  EXPECT_EQ(c.runs[8].settings.t_end_s, 6.0);
  EXPECT_EQ(c.runs[8].settings.parameters.at("restitution"), 0.5);
}

TEST_F(CampaignTest, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(refusal("name = \"x\"\n"), AllOf(HasSubstr(file.string()), HasSubstr("runs")));
  const std::string head = "name = \"x\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"wcsph\"\n";
  EXPECT_THAT(refusal(head + "l0 = [0.05]\n"), HasSubstr("l0_m"));
  EXPECT_THAT(refusal(head + "l0_m = [0.05]\nalhpa = [1.0]\n"), AllOf(HasSubstr(":6:"), HasSubstr("alhpa")));
  EXPECT_THAT(refusal(head + "l0_m = 0.05\n"), AllOf(HasSubstr(":5:"), HasSubstr("array of numbers")));
  EXPECT_THAT(refusal(head + "l0_m = [0.5]\n"), HasSubstr("runs[0]"));
  EXPECT_THAT(refusal(head + "l0_m = [0.05]\nwalls = [\"glass\"]\n"), HasSubstr("glass"));
  EXPECT_THAT(refusal(head + "l0_m = [0.05, 0.05]\n"), HasSubstr("occurs twice"));
  EXPECT_THAT(refusal(head + "l0_m = [0.05\n"), HasSubstr("syntax"));
  EXPECT_THAT(refusal("name = \"x\"\n[[runs]]\ncase = \"kleefman\"\n"),
              AllOf(HasSubstr("c.toml:3: runs[0].case: no case `kleefman`"), HasSubstr("kleefsman")));
}

TEST_F(CampaignTest, TooManyRunsAreRefused) {
  std::string lists = "name = \"x\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"wcsph\"\nl0_m = [0.05";
  for (int k = 30; k < 50; ++k) lists += fmt::format(", 0.0{}", k);
  lists += "]\nalpha = [0.1";
  for (int k = 1; k < 500; ++k) lists += fmt::format(", 0.1{:03}", k);
  EXPECT_THAT(refusal(lists + "]\n"), HasSubstr("more than 10000 runs"));
}

TEST_F(CampaignTest, NumbersAlikeInSixDigitsAreRunsOfTheirOwn) {
  const Campaign c = load(
      "name = \"c\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\nparameters = { restitution = "
      "0.1234567 }\n"
      "[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\nparameters = { restitution = 0.1234568 }\n");
  EXPECT_EQ(c.runs.size(), 2U);
  EXPECT_EQ(c.runs[0].directory.filename(), "kleefsman-mps-dummies-l0.050-restitution0.1234567");
}

/// Their reports would go to one folder.
TEST_F(CampaignTest, CasesOfOneNameAreRefused) {
  const std::string copy = (directory / "copy.toml").string();
  fs::copy_file(load_case("kleefsman").file, copy);
  const auto group = [](double l0_m, const std::string& name) {
    return fmt::format("[[runs]]\nsolver = \"mps\"\nl0_m = [{}]\ncase = \"{}\"\n", l0_m, name);
  };
  const std::string both = "name = \"c\"\n" + group(0.05, "kleefsman") + group(0.04, copy);
  EXPECT_THAT(refusal(both), AllOf(HasSubstr("c.toml:9"), HasSubstr("call themselves kleefsman")));
  fs::remove(copy);
  fs::create_symlink(fs::absolute(load_case("kleefsman").file), copy);  // one case by two ways
  EXPECT_EQ(load(both).cases.size(), 1U);
}

}  // namespace
}  // namespace sluice
