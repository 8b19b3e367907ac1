#include "validation/legs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sluice {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 5> all_keys{"commit", "compiler", "flags", "machine", "threads"};

/// What the legs state under a key, in their order, neighbours that are equal once.
std::vector<std::string> values_of(const json& legs, const char* key) {
  std::vector<std::string> values;
  for (const json& leg : legs) {
    if (!leg.is_object() || !leg.contains(key)) continue;
    const json& value = leg.at(key);
    values.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  }
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

json leg_of(const json& manifest, double from_s) {
  json leg{{"from_s", from_s}};
  for (const char* key : all_keys) leg[key] = manifest.at(key);
  return leg;
}

std::string difference_of_legs(const json& manifest, std::initializer_list<const char*> keys) {
  const auto legs = manifest.find("legs");
  if (legs == manifest.end() || !legs->is_array()) return "";
  std::vector<std::string> differences;
  for (const char* key : keys.size() > 0 ? std::span(keys) : std::span<const char* const>(all_keys))
    if (const auto values = values_of(*legs, key); values.size() > 1)
      differences.push_back(fmt::format("{} ({})", key, fmt::join(values, ", then ")));
  return differences.empty() ? ""
                             : fmt::format("its parts were computed with different {}", fmt::join(differences, ", "));
}

}  // namespace sluice
