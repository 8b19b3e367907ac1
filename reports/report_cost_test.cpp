// What a report says of costs.
#include <gtest/gtest.h>

#include "reports/report.h"
#include "reports/synthetic_run.h"
#include "reports/tables.h"
#include "reports/test_files.h"
#include "reports/test_tables.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeRun;

using test_files::cell;
using test_files::fresh;

TEST(CostTables, ProcessorTimeIsTheCostAndWallTimeStandsIn) {
  AnalysedRun run;
  EXPECT_FALSE(processor_time_s(run));
  run.record.manifest = {{"wall_time_s", 10.0}, {"threads", 2}};
  EXPECT_EQ(processor_time_s(run), 20.0);
  run.record.manifest["cpu_time_s"] = 15.0;
  EXPECT_EQ(processor_time_s(run), 15.0);
}

TEST(CostTables, CostsOfTheTwoMethodsStandSideBySideAtEqualParticleDistance) {
  const fs::path wcsph = fresh("cost_wcsph");
  const fs::path mps = fresh("cost_mps");
  synthetic::write_run(wcsph, {});
  EXPECT_TRUE(cost_ratio_table(analyse({wcsph})).rows.empty()) << "one method alone has no ratio";
  MadeRun run;
  run.solver = "mps";
  run.walls = "dummies";
  synthetic::write_run(mps, run);
  test_files::put_in_manifest(mps, {{"wall_time_s", 1800.0}});
  const Table table = cost_ratio_table(analyse({mps, wcsph}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_NEAR(*table.rows[0].cells.back().value, 2.0, 1e-9);
  EXPECT_NEAR(*table.rows[1].cells.back().value, 223200.0 / 126000.0, 1e-9) << "the paper's";
  test_files::put_in_manifest(mps, {{"t_end_s", 3.0}});
  EXPECT_TRUE(cost_ratio_table(analyse({mps, wcsph})).rows.empty()) << "not to different ends";
  run.l0_m = 0.03;
  synthetic::write_run(mps, run);
  EXPECT_TRUE(cost_ratio_table(analyse({mps, wcsph})).rows.empty()) << "not at different ones";
}

TEST(CostTables, CostsOfDifferentMachinesHaveNoRatio) {
  const fs::path wcsph = fresh("cost_one_machine");
  const fs::path mps = fresh("cost_another_machine");
  synthetic::write_run(wcsph, {});
  synthetic::write_run(mps, {.solver = "mps", .walls = "dummies"});
  const auto ratio = [&](const nlohmann::json& of_mps) {
    test_files::put_in_manifest(mps, of_mps);
    return cost_ratio_table(analyse({mps, wcsph})).rows[0].cells.back().text;
  };
  const auto verdict = [&] {
    return cell(conclusions_table(analyse({mps, wcsph})), "MPS costs 1.77 times WCSPH", "verdict").text;
  };
  EXPECT_EQ(ratio({{"machine", "a machine"}}), "1.00");
  EXPECT_EQ(verdict(), "does not agree");
  EXPECT_EQ(ratio({{"machine", "another"}}), "missing");
  EXPECT_EQ(verdict(), "missing");
  EXPECT_EQ(ratio({{"machine", "a machine"}, {"legs", {{{"machine", "another"}}, {{"machine", "a machine"}}}}}),
            "missing")
      << "a machine computed the last part alone";
  EXPECT_EQ(verdict(), "missing");
  for (const fs::path& run : {mps, wcsph}) test_files::put_in_manifest(run, {{"machine", nullptr}, {"legs", nullptr}});
  EXPECT_EQ(ratio(nlohmann::json::object()), "missing") << "two that do not say may be two";
  EXPECT_EQ(verdict(), "missing");
}

}  // namespace
}  // namespace sluice
