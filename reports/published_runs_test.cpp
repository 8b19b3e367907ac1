// The runs on record with their series: anyone can put them beside his own.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/analysis.h"
#include "validation/case.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// The run directories of every published set that has any.
std::map<std::string, std::vector<fs::path>> published_runs() {
  std::map<std::string, std::vector<fs::path>> sets;
  for (const fs::directory_entry& set : fs::directory_iterator(resolve_in_source_tree("reports/published"))) {
    if (!fs::is_directory(set.path() / "runs")) continue;
    for (const fs::directory_entry& run : fs::directory_iterator(set.path() / "runs"))
      if (run.is_directory()) sets[set.path().filename().string()].push_back(run.path());
  }
  return sets;
}

/// Whole, or interrupted and saying so: then the series reaches as far as the manifest says.
TEST(PublishedRuns, HaveEndedAndCanBeReported) {
  const auto sets = published_runs();
  EXPECT_FALSE(sets.empty());
  for (const auto& [name, directories] : sets) {
    SCOPED_TRACE(name);
    const ReportData data = analyse(directories);
    ASSERT_EQ(data.runs.size(), directories.size());
    for (const AnalysedRun& run : data.runs) {
      SCOPED_TRACE(run.record.path.string());
      ASSERT_GT(run.record.probes.rows(), 0U);
      if (!run.record.own) continue;
      const bool interrupted = run.record.status() == "interrupted";
      EXPECT_TRUE(interrupted || run.record.status() == "finished") << run.record.status();
      const double end_s = run.record.number(interrupted ? "time_s" : "t_end_s").value_or(-1);
      EXPECT_NEAR(run.record.probes.times_s().back(), end_s, 0.002 * end_s);
    }
  }
}

}  // namespace
}  // namespace sluice
