#include "reports/fitted_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "reports/text.h"

namespace sluice {

namespace {

constexpr double much = 0.01;

/// What a flow depends on: a side of a box, the water's way to a body, the room behind the body.
struct FlowLength {
  std::string box;   ///< "fluid[0]", as the manifest has it
  std::string what;  ///< "high", "from fluid[0]"
  double length_m = 0;
};

Box fitted_box(const std::string& name, const Box& box, const std::vector<FittedLength>& fitted) {
  const auto at = [&](const char* end, char axis, double nominal_m) {
    const std::string full = fmt::format("{}.{}.{}", name, end, axis);
    const auto found =
        std::find_if(fitted.begin(), fitted.end(), [&](const auto& length) { return length.name == full; });
    return found == fitted.end() ? nominal_m : found->fitted_m;
  };
  const auto corner = [&](const char* end, const Vec3d& nominal) {
    return Vec3d{at(end, 'x', nominal.x), at(end, 'y', nominal.y), at(end, 'z', nominal.z)};
  };
  return {corner("lower", box.lower), corner("upper", box.upper)};
}

void add_sides(std::vector<FlowLength>& lengths, const std::string& name, const Box& box) {
  const Vec3d sides = box.upper - box.lower;
  lengths.push_back({name, "long", sides.x});
  lengths.push_back({name, "wide", sides.y});
  lengths.push_back({name, "high", sides.z});
}

struct NamedBox {
  std::string name;
  Box drawn;
  Box fitted;
};

/// Along the horizontal axes on which the water and a body are apart.
void add_ways(std::vector<FlowLength>& lengths, const NamedBox& water, const NamedBox& body, const Box& tank) {
  for (const auto axis : {&Vec3d::x, &Vec3d::y}) {
    const bool is_behind = body.drawn.upper.*axis <= water.drawn.lower.*axis;  // the water runs down the axis
    const bool is_before = body.drawn.lower.*axis >= water.drawn.upper.*axis;
    if (!is_behind && !is_before) continue;
    const Box& from = water.fitted;
    const Box& to = body.fitted;
    lengths.push_back({body.name, "from " + water.name,
                       is_behind ? from.lower.*axis - to.upper.*axis : to.lower.*axis - from.upper.*axis});
    lengths.push_back({body.name, "from the wall behind it",
                       is_behind ? to.lower.*axis - tank.lower.*axis : tank.upper.*axis - to.upper.*axis});
  }
}

/// Of all fluid, and of bodies that are not plates: those are as thick as three particles. Empty where the run does not
/// say what it fitted.
std::vector<FlowLength> flow_lengths(const Case& c, const RunRecord& run) {
  std::vector<FlowLength> lengths;
  const auto fitted = fitted_lengths(run);
  if (!fitted) return lengths;
  std::vector<NamedBox> waters;
  for (std::size_t k = 0; k < c.fluid.size(); ++k) {
    const std::string name = fmt::format("fluid[{}]", k);
    waters.push_back({name, c.fluid[k], fitted_box(name, c.fluid[k], *fitted)});
    add_sides(lengths, name, waters.back().fitted);
  }
  const Box tank = fitted_box("tank", c.tank, *fitted);
  const std::vector<Obstacle> obstacles = placed_obstacles(c, run);
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (obstacles[k].thin) continue;
    const std::string name = called(obstacles[k], k);
    const NamedBox body{name, c.obstacles[k].box, fitted_box(name, obstacles[k].box, *fitted)};
    add_sides(lengths, name, body.fitted);
    for (const NamedBox& water : waters) add_ways(lengths, water, body, tank);
  }
  return lengths;
}

}  // namespace

std::optional<std::vector<FittedLength>> fitted_lengths(const RunRecord& run) {
  const auto found = run.manifest.find("fitted_lengths");
  if (found == run.manifest.end() || !found->is_array()) return std::nullopt;
  std::vector<FittedLength> lengths;
  for (const auto& length : *found) {
    if (!length.is_object()) continue;
    const auto is = [&](const char* key, auto test) { return length.contains(key) && test(length[key]); };
    const auto is_number = [](const auto& value) { return value.is_number(); };
    if (is("name", [](const auto& value) { return value.is_string(); }) && is("nominal_m", is_number) &&
        is("fitted_m", is_number))
      lengths.push_back({length["name"], length["nominal_m"], length["fitted_m"]});
  }
  return lengths;
}

std::string differing_geometry(const ReportData& data, const ResolutionSeries& series) {
  std::vector<std::vector<FlowLength>> runs;
  for (const AnalysedRun* run : series.runs)
    if (auto lengths = flow_lengths(data.the_case, run->record); !lengths.empty()) runs.push_back(std::move(lengths));
  std::string out;
  for (std::size_t k = 0; runs.size() > 1 && k < runs.front().size(); ++k) {
    const auto [least, most] = std::minmax_element(
        runs.begin(), runs.end(), [&](const auto& a, const auto& b) { return a[k].length_m < b[k].length_m; });
    if ((*most)[k].length_m <= (1 + much) * (*least)[k].length_m) continue;
    std::string values;
    for (const auto& run : runs) values += (values.empty() ? "" : ", ") + significant(run[k].length_m, 3);
    const FlowLength& length = runs.front()[k];
    out += fmt::format("{}{} is {} m {}", out.empty() ? "" : "; ", length.box, values, length.what);
  }
  return out;
}

}  // namespace sluice
