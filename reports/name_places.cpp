#include "reports/name_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reports/text.h"

namespace sluice {
namespace {

constexpr double character_px = 9;
constexpr double line_px = 16;
constexpr double marker_px = 10;
constexpr double gap_px = 7;  // between a point and a name beside it
constexpr int steps_away = 10;
constexpr double step_px = 9;

/// Beside first, for there a name is nearest to its point.
constexpr std::array<PlacePx, 8> directions{{{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};

struct NameBox {
  PlacePx centre;
  double width_px = 0;
  double height_px = 0;
};

NameBox box_around(const std::string& name, PlacePx centre) {
  return {centre, character_px * static_cast<double>(characters(name)), line_px};
}

double common_length(double a, double a_length, double b, double b_length) {
  const double begin = std::max(a - a_length / 2, b - b_length / 2);
  const double end = std::min(a + a_length / 2, b + b_length / 2);
  return std::max(0.0, end - begin);
}

double common_area(const NameBox& a, const NameBox& b) {
  return common_length(a.centre.x, a.width_px, b.centre.x, b.width_px) *
         common_length(a.centre.y, a.height_px, b.centre.y, b.height_px);
}

double covered(const NameBox& box, const std::vector<NameBox>& taken, PlacePx area) {
  const NameBox whole{{area.x / 2, area.y / 2}, area.x, area.y};
  double sum = box.width_px * box.height_px - common_area(box, whole);
  for (const NameBox& other : taken) sum += common_area(box, other);
  return sum;
}

/// The line from a point to the centre ends at the box.
PlacePx edge_towards(const NameBox& box, PlacePx point) {
  const PlacePx d{point.x - box.centre.x, point.y - box.centre.y};
  const double across = std::abs(d.x) > 0 ? box.width_px / 2 / std::abs(d.x) : std::numeric_limits<double>::infinity();
  const double up = std::abs(d.y) > 0 ? box.height_px / 2 / std::abs(d.y) : std::numeric_limits<double>::infinity();
  const double share = std::min({across, up, 1.0});
  return {box.centre.x + share * d.x, box.centre.y + share * d.y};
}

/// The nearest place that covers nothing, or the one that covers least.
NamePlace best_place(const NamedPoint& point, const std::vector<NameBox>& taken, PlacePx area) {
  NameBox box = box_around(point.name, point.at);
  NamePlace best;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < steps_away && least > 0; ++step)
    for (const PlacePx& to : directions) {
      const double away = gap_px + step_px * step;
      box.centre = {point.at.x + to.x * (away + box.width_px / 2), point.at.y + to.y * (away + box.height_px / 2)};
      const double covers = covered(box, taken, area);
      if (covers >= least) continue;
      least = covers;
      best = {box.centre, edge_towards(box, point.at), step > 0};
    }
  return best;
}

}  // namespace

std::vector<NamePlace> place_names(const std::vector<NamedPoint>& points, PlacePx area_px) {
  std::vector<NameBox> taken;
  for (const NamedPoint& point : points) taken.push_back({point.at, marker_px, marker_px});
  std::vector<NamePlace> places;
  for (const NamedPoint& point : points) {
    places.push_back(best_place(point, taken, area_px));
    taken.push_back(box_around(point.name, places.back().centre));
  }
  return places;
}

}  // namespace sluice
