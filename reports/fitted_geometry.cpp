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

/// How long a box is along one axis.
struct Side {
  std::string box;  ///< "fluid[0]", as the manifest has it
  char axis = 'x';
  double length_m = 0;
};

void add_sides(std::vector<Side>& sides, const std::string& name, const Box& box,
               const std::vector<FittedLength>& fitted) {
  const auto at = [&](const char* end, char axis, double nominal_m) {
    const std::string full = fmt::format("{}.{}.{}", name, end, axis);
    const auto found =
        std::find_if(fitted.begin(), fitted.end(), [&](const auto& length) { return length.name == full; });
    return found == fitted.end() ? nominal_m : found->fitted_m;
  };
  const auto add = [&](char axis, double lower_m, double upper_m) {
    sides.push_back({name, axis, at("upper", axis, upper_m) - at("lower", axis, lower_m)});
  };
  add('x', box.lower.x, box.upper.x);
  add('y', box.lower.y, box.upper.y);
  add('z', box.lower.z, box.upper.z);
}

/// Of all fluid, and of bodies that are not plates: those are as thick as three particles. Empty where the run does not
/// say what it fitted.
std::vector<Side> fitted_sides(const Case& c, const RunRecord& run) {
  std::vector<Side> sides;
  const auto fitted = fitted_lengths(run);
  if (!fitted) return sides;
  for (std::size_t k = 0; k < c.fluid.size(); ++k) add_sides(sides, fmt::format("fluid[{}]", k), c.fluid[k], *fitted);
  const std::vector<Obstacle> obstacles = placed_obstacles(c, run);
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    if (!obstacles[k].thin) add_sides(sides, called(obstacles[k], k), obstacles[k].box, *fitted);
  return sides;
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
  std::vector<std::vector<Side>> runs;
  for (const AnalysedRun* run : series.runs)
    if (auto sides = fitted_sides(data.the_case, run->record); !sides.empty()) runs.push_back(std::move(sides));
  std::string out;
  for (std::size_t k = 0; runs.size() > 1 && k < runs.front().size(); ++k) {
    const auto [least, most] = std::minmax_element(
        runs.begin(), runs.end(), [&](const auto& a, const auto& b) { return a[k].length_m < b[k].length_m; });
    if ((*most)[k].length_m <= (1 + much) * (*least)[k].length_m) continue;
    std::string lengths;
    for (const auto& sides : runs) lengths += (lengths.empty() ? "" : ", ") + significant(sides[k].length_m, 3);
    const Side& side = runs.front()[k];
    out += fmt::format("{}{} is {} m {}", out.empty() ? "" : "; ", side.box, lengths,
                       side.axis == 'x'   ? "long"
                       : side.axis == 'y' ? "wide"
                                          : "high");
  }
  return out;
}

}  // namespace sluice
