#include "reports/name_places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

constexpr PlacePx area{535, 222};

/// Of two names of as many characters each.
bool overlap(const NamePlace& a, const NamePlace& b, double characters) {
  return std::abs(a.centre.x - b.centre.x) < 8 * characters && std::abs(a.centre.y - b.centre.y) < 14;
}

TEST(PlaceNames, ALonePointHasItsNameBesideIt) {
  const auto places = place_names({{{100, 100}, "R1"}}, area);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_FALSE(places[0].apart);
  EXPECT_EQ(places[0].centre.y, 100);
  EXPECT_GT(places[0].centre.x, 110);
  EXPECT_LT(places[0].centre.x, 125);
}

TEST(PlaceNames, AtTheEdgeTheNameStandsInside) {
  const auto places = place_names({{{534, 100}, "R1"}, {{100, 221}, "R2"}}, area);
  EXPECT_LT(places[0].centre.x, 525);
  EXPECT_LT(places[1].centre.y, 215);
}

TEST(PlaceNames, ACrowdOfPointsHasNamesThatCanBeRead) {
  std::vector<NamedPoint> points;
  for (int k = 0; k < 14; ++k) points.push_back({{200.0 + 3 * (k % 4), 90.0 + 2 * k}, "R" + std::to_string(10 + k)});
  const auto places = place_names(points, area);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_GT(places[i].centre.x, 0);
    EXPECT_LT(places[i].centre.x, area.x);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(places[i], places[j], 3)) << i << " and " << j;
    for (const NamedPoint& point : points)
      EXPECT_FALSE(std::abs(places[i].centre.x - point.at.x) < 12 && std::abs(places[i].centre.y - point.at.y) < 7);
  }
}

/// A line leads from a point to the edge of a name that stands apart, not into its letters.
TEST(PlaceNames, LinesEndAtTheName) {
  const std::vector<NamedPoint> points(12, {{250, 110}, "R10"});
  bool any = false;
  for (const NamePlace& place : place_names(points, area)) {
    if (!place.apart) continue;
    any = true;
    const double across = std::abs(place.line_end.x - place.centre.x);
    const double up = std::abs(place.line_end.y - place.centre.y);
    EXPECT_TRUE(std::abs(across - 13.5) < 1e-9 || std::abs(up - 8) < 1e-9) << across << " " << up;
  }
  EXPECT_TRUE(any);
}

TEST(PlaceNames, WithoutRoomTheyAreThereAllTheSame) {
  const std::vector<NamedPoint> points(500, {{250, 110}, "R100"});
  EXPECT_EQ(place_names(points, area).size(), 500U);
}

}  // namespace
}  // namespace sluice
