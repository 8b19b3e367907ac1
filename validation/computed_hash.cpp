#include "validation/computed_hash.h"

#include <array>
#include <nlohmann/json.hpp>

#include "validation/file_hash.h"

namespace sluice {
namespace {

using nlohmann::json;

// What nothing is computed from. A key that is missing here costs runs, a wrong one makes runs pass for what they are
// not: in doubt a key stays out. Tiers are names: the particle distance and the end that a run took from one are told
// by its own settings.
constexpr std::array keys_of_judgement{"title", "reference", "assumptions", "measured",
                                       "tiers", "window_s",  "acceptance",  "published"};
constexpr std::array sensor_keys_of_judgement{"measured",         "measured_in", "measured_shift_s",
                                              "measured_is_band", "window_s",    "impulses_s"};

/// Tables with their keys in order. Numbers all as one type: 1 and 1.0 are the same input.
json canonical(const toml::node& node) {
  json all;
  if (const toml::table* table = node.as_table()) {
    all = json::object();
    for (const auto& [key, value] : *table) all[std::string(key.str())] = canonical(value);
  } else if (const toml::array* array = node.as_array()) {
    all = json::array();
    for (const toml::node& value : *array) all.push_back(canonical(value));
  } else if (node.is_number()) {
    all = node.value<double>().value();
  } else if (node.is_boolean()) {
    all = node.value<bool>().value();
  } else {
    all = node.value<std::string>().value_or("");  // a case has no dates
  }
  return all;
}

}  // namespace

std::string computed_hash(const toml::table& the_case) {
  json inputs = canonical(the_case);
  for (const char* key : keys_of_judgement) inputs.erase(key);
  if (inputs.contains("sensors"))
    for (json& sensor : inputs["sensors"])
      for (const char* key : sensor_keys_of_judgement) sensor.erase(key);
  return text_hash(inputs.dump());
}

}  // namespace sluice
