// Both methods on one axis, and sensors on the faces that carry them: figures after the paper's own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "reports/report.h"
#include "reports/series_panels.h"
#include "reports/studies.h"
#include "reports/synthetic_run.h"
#include "reports/tables.h"
#include "reports/test_files.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeRun;

using test_files::fresh;
using test_files::read;

std::vector<std::string> labels_of_runs(const PlotPanel& panel) {
  std::vector<std::string> labels;
  for (const PlotCurve& curve : panel.curves)
    if (curve.look == CurveLook::run) labels.push_back(curve.label);
  return labels;
}

/// MPS at l0 = 20 mm beside WCSPH: two alphas and both walls there, and one run at 30 mm.
class BothMethods : public testing::Test {
 protected:
  void SetUp() override {
    MadeRun made;
    made.t_end_s = 1;
    add(made);
    made.alpha = 0.001;
    add(made);
    made.walls = "dynamic";
    add(made);
    made.walls = "extrapolated";
    made.l0_m = 0.03;
    add(made);
    made.solver = "mps";
    made.walls = "dummies";
    made.l0_m = 0.02;
    add(made);
  }
  void add(const MadeRun& made) {
    runs_.push_back(fresh("methods_" + std::to_string(runs_.size())));
    synthetic::write_run(runs_.back(), made);
  }
  /// What is drawn of P1; the words say which runs go beyond 1 Pa.
  std::vector<PlotPanel> panels(const ReportData& data) {
    cut_ = {0.001, "kPa", ""};
    return shared_panels(data, method_groups(data, runs_a_panel), *data.the_case.find_sensor("P1"),
                         {"", data.window, true}, cut_);
  }

  std::vector<fs::path> runs_;
  Cut cut_;
};

/// What the author of another code looks for: the own curve, the experiment and the references in one picture.
TEST_F(BothMethods, OtherCodesShareAPanelWithTheFinestRunOfEach) {
  const fs::path other = fresh("methods_other");
  synthetic::write_external_run(other, 2.0);
  runs_.push_back(other);
  add({.l0_m = 0.015});
  const ReportData data = analyse(runs_);
  const auto groups = beside_references(data, runs_a_panel);
  ASSERT_EQ(groups.size(), 1U);
  ASSERT_EQ(groups[0].runs.size(), 4U) << "MPS, two walls of WCSPH, and the other code";
  EXPECT_EQ(groups[0].runs[1]->record.l0_m, 0.015) << groups[0].runs[1]->label;
  EXPECT_FALSE(groups[0].runs[3]->record.own);
  Cut cut;
  const auto drawn = shared_panels(data, groups, *data.the_case.find_sensor("P1"), {"", data.window, true}, cut);
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(labels_of_runs(drawn[0]).size(), 4U);
  const auto pictures = other_code_figures({data, fresh("methods_other_figures")}, SensorKind::pressure);
  ASSERT_EQ(pictures.size(), 1U) << "it has P1 alone";
  EXPECT_EQ(pictures[0].name, "codes_P1");
  runs_.erase(std::find(runs_.begin(), runs_.end(), other));
  EXPECT_TRUE(beside_references(analyse(runs_), runs_a_panel).empty());
  std::vector<fs::path> codes;
  for (int k = 0; k < 6; ++k) {
    codes.push_back(fresh("methods_code_" + std::to_string(k)));
    synthetic::write_external_run(codes.back(), 1 + 0.01 * k);
    test_files::put_in_manifest(codes.back(), {{"solver", k < 3 ? "one" : "two"}});
  }
  const ReportData others = analyse(codes);
  for (const RunGroup& group : beside_references(others, runs_a_panel))
    EXPECT_NE(group.runs.front()->group, group.runs.back()->group) << "of two codes each panel has both";
}

TEST_F(BothMethods, ShareAPanelOfOneParticleDistanceAndWallModel) {
  const auto drawn = panels(analyse(runs_));
  ASSERT_EQ(drawn.size(), 2U);
  EXPECT_EQ(drawn[0].title, "P1: l0 = 20 mm, MPS and WCSPH, extrapolated walls");
  EXPECT_EQ(labels_of_runs(drawn[0]), (std::vector<std::string>{"R1 MPS, α = 0.001, wall", "R3 WCSPH, α = 0.01, wall",
                                                                "R4 WCSPH, α = 0.001, wall"}));
  EXPECT_EQ(drawn[1].title, "P1: l0 = 20 mm, MPS and WCSPH, dynamic walls");
  EXPECT_EQ(labels_of_runs(drawn[1]),
            (std::vector<std::string>{"R1 MPS, α = 0.001, wall", "R5 WCSPH, α = 0.001, kernel"}));
  for (const PlotPanel& panel : drawn) EXPECT_FALSE(panel.bands.empty()) << "the experiment";
  EXPECT_EQ(cut_.words.find("R1 "), 0U) << cut_.words;
  EXPECT_EQ(cut_.words.rfind("R1 "), 0U) << "once, though it is in both panels: " << cut_.words;
}

TEST_F(BothMethods, NeedEqualParticleDistanceAndEndAndTheSensor) {
  ReportData data = analyse(runs_);
  data.runs.front().readings.clear();
  EXPECT_TRUE(panels(data).empty()) << "MPS without a reading";
  EXPECT_EQ(cut_.words, "");
  const fs::path mps = runs_.back();
  test_files::put_in_manifest(mps, {{"t_end_s", 3.0}});
  EXPECT_TRUE(panels(analyse(runs_)).empty()) << "another end";
  test_files::put_in_manifest(mps, {{"t_end_s", 6.0}, {"l0_m", 0.015}});
  EXPECT_TRUE(panels(analyse(runs_)).empty()) << "another particle distance";
  runs_.pop_back();
  EXPECT_TRUE(panels(analyse(runs_)).empty()) << "WCSPH alone";
  EXPECT_TRUE(panels(analyse({mps})).empty()) << "MPS alone";
}

TEST_F(BothMethods, AreDividedWhereAPanelHasNoRoom) {
  const ReportData data = analyse(runs_);
  const auto groups = method_groups(data, 2);
  ASSERT_EQ(groups.size(), 3U);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    ASSERT_EQ(groups[k].runs.size(), 2U);
    EXPECT_EQ(groups[k].runs[0]->key, "R1");
    EXPECT_EQ(groups[k].runs[1]->key, fmt::format("R{}", k + 3));
  }
}

TEST_F(BothMethods, AreDrawnForTheSensorsOfThePapersFigures) {
  const ReportData data = analyse(runs_);
  const fs::path out = fresh("methods_out");
  const auto pictures = method_figures({data, out}, SensorKind::pressure);
  ASSERT_EQ(pictures.size(), 3U) << "P1 to P3";
  EXPECT_NE(pictures[0].caption.find("the paper's figure 7"), std::string::npos) << pictures[0].caption;
  const std::string drawn = read(out / "figures/methods_P1.dat");
  for (const char* curve : {"# curve: R1 MPS", "# curve: R3 WCSPH", "# curve: experiment"})
    EXPECT_NE(drawn.find(curve), std::string::npos) << curve;
}

TEST(ReportFigures, EveryPressureSensorIsNamedOnTheFaceThatCarriesIt) {
  const fs::path run = fresh("faces_run");
  const fs::path out = fresh("faces_out");
  MadeRun made;
  made.t_end_s = 1;
  synthetic::write_run(run, made);
  ReportData data = analyse({run});
  ASSERT_EQ(sensor_face_figures({data, out}).size(), 1U);
  const std::string drawn = read(out / "figures/pressure_sensors.dat");
  for (const std::string& sensor : data.sensors(SensorKind::pressure))
    EXPECT_NE(drawn.find("\"" + sensor + "\""), std::string::npos) << sensor;
  EXPECT_NE(drawn.find("0.4745 0.021 \"P1\""), std::string::npos) << "y across, z up";
  EXPECT_NE(drawn.find("0.5255 0.8035 \"P5\""), std::string::npos) << "the longer side across";
  const std::string script = read(out / "figures/pressure_sensors.gp");
  for (const char* words : {"Face x+ of the obstacle", "Face z+ of the obstacle", "set size ratio -1"})
    EXPECT_NE(script.find(words), std::string::npos) << words;

  auto& sensors = data.the_case.sensors;
  std::erase_if(sensors, [](const CaseSensor& s) { return s.name != "P1" && s.name != "P5"; });
  EXPECT_EQ(sensor_face_figures({data, out}).size(), 1U) << "two faces of one body";
  sensors.pop_back();
  EXPECT_TRUE(sensor_face_figures({data, out}).empty()) << "one sensor alone";
}

}  // namespace
}  // namespace sluice
