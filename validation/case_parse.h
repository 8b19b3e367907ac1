// Inner parts of parse_case(), one function a section of the case file; not for use elsewhere.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/case.h"
#include "validation/toml_reader.h"

namespace sluice::case_parse {

template <class T>
std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.emplace_back(item.name);
  return names;
}

template <class T>
void refuse_repeated_name(const TomlReader& reader, const std::vector<T>& items, const std::string& name) {
  for (const T& item : items)
    if (item.name == name) reader.fail("name", "`" + name + "` occurs twice (give each its own name)");
}

/// Whether a point lies in a box or on its faces, as far as drawn lengths tell.
bool inside(const Box& box, const Vec3d& p);

/// The key's text, which must be one of the choices.
std::string one_of(TomlReader& reader, std::string_view key, const std::vector<std::string>& choices);

/// A span of time, or several, that do not start before 0; none where the key is absent.
TimeWindow parse_window(TomlReader& reader, std::string_view key);
std::vector<TimeWindow> parse_windows(TomlReader& reader, std::string_view key);

Vec3d parse_unit_vector(TomlReader& reader, std::string_view key);

/// The case's geometry and the sensors before this one must be there already.
CaseSensor parse_sensor(TomlReader& reader, const Case& c);

/// Appends the rows of one [[acceptance]] group; the case's sensors and solvers must be there already.
void parse_acceptance_group(TomlReader& reader, Case& c);

void parse_published(TomlReader reader, Case& c);

}  // namespace sluice::case_parse
