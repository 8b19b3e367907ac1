#include "ci/early_flow.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sluice::ci {
namespace {

ProbeTable table(std::vector<double> times_s, std::vector<double> kinetic_J, std::vector<double> potential_J,
                 std::vector<double> density_ratio) {
  return {"probes.csv",
          {"kinetic_energy_J", "potential_energy_J", "greatest_density_ratio_1"},
          std::move(times_s),
          {std::move(kinetic_J), std::move(potential_J), std::move(density_ratio)}};
}

TEST(EarlyFlow, EndsBeforeTheColumnOfKleefsmanMeetsTheBox) {
  EXPECT_NEAR(early_flow_end_s(0.55, 9.81), 0.284, 1e-3);
}

TEST(EarlyFlow, SharesOfTheEnergyAtTheStart) {
  const auto flow = early_flow(table({0, 0.1, 0.2, 0.3}, {0, 10, 30, 99}, {100, 88, 64, 1}, {1.0, 1.01, 1.02, 5}), 0.2);
  ASSERT_TRUE(flow);
  EXPECT_DOUBLE_EQ(flow->kinetic_energy_share, 0.3);
  EXPECT_NEAR(flow->energy_lost_share, (0 + 0.02 + 0.06) / 3, 1e-15);
  EXPECT_NEAR(flow->compression, 0.01, 1e-15);
}

TEST(EarlyFlow, NothingFromRunsThatEndTooEarlyOrDoNotTell) {
  EXPECT_FALSE(early_flow(table({0, 0.1}, {0, 10}, {100, 88}, {1, 1}), 0.2));
  EXPECT_FALSE(early_flow(table({}, {}, {}, {}), 0.2));
  EXPECT_FALSE(early_flow(table({0, 0.3}, {0, 10}, {0, 88}, {1, 1}), 0.2));
  EXPECT_FALSE(early_flow(ProbeTable("probes.csv", {"P1_Pa"}, {0, 0.3}, {{1, 2}}), 0.2));
}

}  // namespace
}  // namespace sluice::ci
