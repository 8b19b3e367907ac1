#include "reports/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "reports/document.h"
#include "reports/gnuplot.h"
#include "reports/snapshot_view.h"

namespace sluice {
namespace {

std::string read(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

std::filesystem::path folder(const std::string& name) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("sluice_plot_" + name);
  std::filesystem::remove_all(path);
  return path;
}

TEST(ThinOut, KeepsPeaksAndOrder) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= 6000; ++i) {
    x.push_back(0.001 * i);
    y.push_back(std::sin(0.01 * i));
  }
  y[2345] = 50;
  y[2346] = -50;
  const auto [tx, ty] = thin_out(x, y, 0, 6, 100);
  EXPECT_LE(tx.size(), 202u);
  EXPECT_TRUE(std::is_sorted(tx.begin(), tx.end()));
  EXPECT_EQ(*std::max_element(ty.begin(), ty.end()), 50);
  EXPECT_EQ(*std::min_element(ty.begin(), ty.end()), -50);
  EXPECT_NEAR(tx[static_cast<std::size_t>(std::max_element(ty.begin(), ty.end()) - ty.begin())], 2.345, 1e-12);
}

TEST(ThinOut, KeepsToTheWindow) {
  const auto [x, y] = thin_out({0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, 1, 3, 10);
  EXPECT_EQ(x, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(y, (std::vector<double>{1, 2, 3}));
}

TEST(Draw, MakesAPictureFromAScriptThatNamesItsData) {
  const auto out = folder("draw");
  PlotFigure figure;
  figure.name = "line";
  figure.panels.resize(2);
  figure.panels[0].y_label = "height_1 [m]";
  figure.panels[0].curves.push_back({"a & b_c", {0, 1, 2}, {0, NAN, 4}, CurveLook::run, 0, false, false, {}});
  figure.panels[1].curves.push_back({"empty", {}, {}, CurveLook::run, 0, false, false, {}});
  const auto picture = draw(figure, out);
  const std::string svg = read(picture);
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("a &amp; b_c"), std::string::npos) << "labels are not read as markup";
  EXPECT_NE(svg.find("no data"), std::string::npos);
  EXPECT_EQ(read(out / "line.dat").find("nan"), std::string::npos);
}

TEST(Draw, MoreCurvesThanColoursStayApart) {
  PlotPanel panel;
  for (int style = 0; style < 12; ++style) {
    PlotCurve curve;
    curve.label = "curve " + std::to_string(style);
    curve.style = style;
    curve.points_only = true;
    curve.x = {1, 2};
    curve.y = {1.0 * style, 2.0 * style};
    panel.curves.push_back(curve);
  }
  PlotFigure figure;
  figure.name = "many";
  figure.panels = {panel};
  const auto out = folder("many");
  draw(figure, out);
  std::istringstream script(read(out / "many.gp"));
  std::set<std::string> looks;
  for (std::string line; std::getline(script, line);)
    if (const auto at = line.find("points pt"); at != std::string::npos)
      looks.insert(line.substr(at, line.find('\'', line.find('\'', at) + 1) - at));
  EXPECT_EQ(looks.size(), 12u);
}

/// Where a text stands in a drawing, from the top.
double height_of_text(const std::string& svg, const std::string& text) {
  const std::regex place("translate\\([-0-9.]+,([-0-9.]+)\\)\"[^>]*>\\s*<text><tspan[^>]*>" + text + "<");
  std::smatch found;
  return std::regex_search(svg, found, place) ? std::stod(found[1]) : NAN;
}

/// However long the entries of a legend, and however many: the axes keep their height, and the last entry has room.
TEST(Draw, ALegendTakesNothingFromThePanel) {
  for (const int width_px : {480, 664, 960})
    for (std::size_t length = 8; length <= 60; length += 4) {
      PlotFigure figure;
      figure.name = "legend";
      figure.panel_width_px = width_px;
      figure.panels.resize(1);
      figure.panels[0].x_label = "time";
      for (int k = 0; k < 7; ++k)
        figure.panels[0].curves.push_back(
            {std::string(length - 1, 'm') + std::to_string(k), {0, 1}, {0, 1}, CurveLook::run, 0, false, false, {}});
      const std::string svg = read(draw(figure, folder("legend")));
      const double axis_px = height_of_text(svg, "time");
      EXPECT_GT(axis_px, 270) << width_px << " " << length;
      EXPECT_LT(axis_px, 330) << width_px << " " << length;
      std::smatch size;
      ASSERT_TRUE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 [0-9]+ ([0-9]+)\"")));
      for (int k = 0; k < 7; ++k)
        EXPECT_LT(height_of_text(svg, std::string(length - 1, 'm') + std::to_string(k)), std::stod(size[1]))
            << width_px << " " << length << " " << k;
    }
}

/// Names of runs come from other people's files.
TEST(Draw, RunsNothingThatStandsInAName) {
  const auto out = folder("names");
  const std::filesystem::path mark = out / "run.txt";
  const std::string name = "x`touch " + mark.string() + "`\nsystem \"touch " + mark.string() + "\"\n";
  PlotFigure figure;
  figure.name = "names";
  figure.source = name;
  figure.panels.resize(1);
  figure.panels[0].title = name;
  figure.panels[0].x_label = name;
  figure.panels[0].y_label = name;
  figure.panels[0].curves.push_back({name, {0, 1}, {0, 1}, CurveLook::run, 0, false, false, {}});
  EXPECT_NE(read(draw(figure, out)).find("<svg"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST(Gnuplot, SaysWhatIsWrongWithAScript) {
  const auto out = folder("broken");
  std::filesystem::create_directories(out);
  std::ofstream(out / "broken.gp") << "plot nonsense from nowhere\n";
  try {
    run_gnuplot(out, {"broken.gp"});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("broken.gp"), std::string::npos) << error.what();
  }
}

TEST(SvgForPage, PrefixesIdentifiersAndDropsTheFixedSize) {
  const std::string svg = svg_for_page(
      "<?xml version=\"1.0\"?>\n<svg width=\"640\" height=\"400\" viewBox=\"0 0 640 400\" "
      "xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n<title>Gnuplot</title>"
      "<circle id='dot' r='1'/><use xlink:href='#dot'/><path clip-path=\"url(#c)\"/></svg>",
      "fig", "a \"line\"");
  EXPECT_EQ(svg,
            "<svg viewBox=\"0 0 640 400\" role=\"img\" aria-label=\"a &quot;line&quot;\">\n"
            "<circle id='fig-dot' r='1'/><use href='#fig-dot'/><path clip-path=\"url(#fig-c)\"/></svg>");
  EXPECT_THROW(svg_for_page("no drawing", "fig", ""), std::runtime_error);
}

TEST(SnapshotView, FarParticlesComeFirstAndHiddenOnesAreLeftOut) {
  Case c;
  c.gravity_m_s2 = {0, 0, -9.81};
  c.water_height_m = 0.5;
  c.density_kg_m3 = 1000;
  ParticleSnapshot snapshot;
  // Along the line of sight: the third lies exactly behind the first.
  const float s = 0.4f;
  snapshot.position_m = {{1, 0, 0.5f}, {2, 0.5f, 0.5f}, {1 - 0.38f * s, s, 0.5f - 0.27f * s}};
  snapshot.pressure_Pa = {0, 4905, 0};
  snapshot.fluid_count = 3;
  const auto discs = snapshot_discs(snapshot, c, 0.02, {});
  ASSERT_EQ(discs.size(), 2u);
  EXPECT_NEAR(discs[0].x, 2 + 0.38 * 0.5, 1e-6) << "the farther of the two seen";
  EXPECT_EQ(discs[0].colour, viridis(1.0));
  EXPECT_EQ(discs[1].colour, viridis(0.0));
}

TEST(SnapshotView, SpeedColoursTheFluidAndLeavesWallsGrey) {
  Case c;
  c.gravity_m_s2 = {0, 0, -9.81};
  c.water_height_m = 0.1;
  c.density_kg_m3 = 1000;
  c.tank = {{0, 0, 0}, {2, 1, 1}};
  c.obstacles = {{{{0.4, 0, 0}, {0.6, 0.2, 0.5}}}};
  ParticleSnapshot snapshot;
  snapshot.position_m = {{1, 0, 0.5f}, {0.5f, 0.1f, 0.2f}};
  snapshot.velocity_m_s = {{0, 0.990454f, 0}, {0, 0, 0}};  // sqrt(g H)
  snapshot.pressure_Pa = {0, 5000};
  snapshot.fluid_count = 1;
  const auto discs = snapshot_discs(snapshot, c, 0.02, {ParticleColour::Of::velocity, 2});
  ASSERT_EQ(discs.size(), 2u);
  EXPECT_EQ(discs[0].colour, 0xB9C2C8u) << "a wall under pressure";
  EXPECT_EQ(discs[1].colour, viridis(0.5));
}

TEST(SnapshotView, ABodyThatMovesIsWhereItIsAtThatTime) {
  const Box tank{{0, 0, 0}, {2, 1, 0.3}};
  Obstacle gate{{{1, 0.4, 0}, {1.1, 0.6, 0.3}}, "gate", true, {{0, 0, 1.25}, 0, 1e9}};
  EXPECT_NEAR(obstacle_at(gate, 0, tank)->lower.z, 0, 1e-12);
  EXPECT_NEAR(obstacle_at(gate, 0.1, tank)->lower.z, 0.125, 1e-12);
  EXPECT_NEAR(obstacle_at(gate, 0.1, tank)->upper.z, 0.3, 1e-12) << "cut off at the open top";
  EXPECT_FALSE(obstacle_at(gate, 0.3, tank)) << "it has left";
}

TEST(SnapshotView, ColoursRunFromDarkToBright) {
  EXPECT_EQ(viridis(-1), 0x440154u);
  EXPECT_EQ(viridis(0), 0x440154u);
  EXPECT_EQ(viridis(1), 0xFDE725u);
  EXPECT_EQ(viridis(7), 0xFDE725u);
}

}  // namespace
}  // namespace sluice
