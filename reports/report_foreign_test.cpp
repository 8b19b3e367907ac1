// Reports on a real delivery of another code: a volume-of-fluid series of the Kleefsman case.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "reports/analysis.h"
#include "reports/report.h"
#include "reports/test_files.h"
#include "validation/digest.h"
#include "validation/foreign.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// Both maps, read as `sluice compare` reads them but for the place of the raw file, which stays with its owner.
class VolumeOfFluidReport : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path raw = raw_data_folder() / "vof_kleefsman/interfoam_161x50x50.csv";
    if (!fs::exists(raw))
      GTEST_SKIP() << "the raw series is not part of the project and " << raw.string()
                   << " is not there; set SLUICE_RAW_DATA to the folder of raw data";
    for (const std::string name : {"interfoam", "interfoam_p2"}) {
      ForeignMap map = load_foreign_map("data/vof_kleefsman/" + name + ".toml");
      map.files.at(0).file = raw;
      runs.push_back(test_files::fresh("vof_" + name));
      import_foreign(map, runs.back());
    }
  }
  void TearDown() override {
    for (const fs::path& run : runs) fs::remove_all(run);
  }

  std::vector<fs::path> runs;
};

TEST_F(VolumeOfFluidReport, TheWholeSeriesGivesItsKnownAnswers) {
  const ReportData data = analyse({runs.at(0)});
  const AnalysedRun& run = data.runs.at(0);
  ASSERT_EQ(run.problems.size(), 1U);
  EXPECT_TRUE(run.problems[0].starts_with("has rows more than 10 ms apart over 67 % of its time")) << run.problems[0];
  const SensorReading* p1 = run.primary("P1");
  ASSERT_NE(p1, nullptr);
  EXPECT_NEAR(p1->comparison.impulse.simulated.value(), 12398.46, 0.01);
  EXPECT_NEAR(p1->comparison.impulse.deviation().value(), 12398.46 / 13391.65 - 1, 1e-5);
  EXPECT_NEAR(p1->comparison.peak.simulated.value(), 9838.2629, 1e-4);
  EXPECT_NEAR(p1->comparison.peak_time_s.simulated.value(), 0.4411, 1e-9);
  EXPECT_NEAR(p1->comparison.arrival_s.simulated.value(), 0.4023, 1e-4);
  EXPECT_NEAR(run.primary("H2")->comparison.peak.simulated.value(), 0.3361, 1e-9);
  EXPECT_EQ(run.primary("P2"), nullptr) << "missing stays missing";
}

TEST_F(VolumeOfFluidReport, ASeriesThatEndsEarlyHasNoImpulseAndSaysSo) {
  const ReportData data = analyse({runs.at(1)});
  const AnalysedRun& run = data.runs.at(0);
  ASSERT_FALSE(run.problems.empty());
  EXPECT_NE(run.problems[0].find("covers 5.89 s of a window that ends at 6.00 s"), std::string::npos)
      << run.problems[0];
  const SensorReading* p2 = run.primary("P2");
  ASSERT_NE(p2, nullptr);
  EXPECT_FALSE(p2->comparison.impulse.simulated);
  EXPECT_NEAR(p2->comparison.arrival_s.simulated.value(), 0.4051, 1e-4);
}

TEST_F(VolumeOfFluidReport, AReportOverBothIsWritten) {
  const fs::path out = test_files::fresh("vof_out");
  ReportOptions options;
  options.figures = false;
  write_report(runs, out, options);
  for (const char* page : {"report.md", "index.html"}) {
    const std::string text = test_files::read(out / page);
    EXPECT_NE(text.find("interFoam (OpenFOAM v2312)"), std::string::npos) << page;
    EXPECT_NE(text.find("5 incomplete rows of its files were left out"), std::string::npos) << page;
  }
  fs::remove_all(out);
}

}  // namespace
}  // namespace sluice
