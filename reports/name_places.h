// Where the names of a figure's points stand, so that none covers another name or a point.
#pragma once

#include <string>
#include <vector>

namespace sluice {

/// In pixels from a corner of the area.
struct PlacePx {
  double x = 0;
  double y = 0;
};

struct NamedPoint {
  PlacePx at;
  std::string name;
};

struct NamePlace {
  PlacePx centre;
  PlacePx line_end;    ///< where a line from the point meets the name's box
  bool apart = false;  ///< so far from its point that a line must lead to it
};

/// One a point, in their order. Names stand beside their points or, where there is no room, further off, inside an area
/// of this width and height; where there is no room at all, where they cover least.
std::vector<NamePlace> place_names(const std::vector<NamedPoint>& points, PlacePx area_px);

}  // namespace sluice
