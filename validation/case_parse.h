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

/// The key's text, which must be one of the choices.
std::string one_of(TomlReader& reader, std::string_view key, const std::vector<std::string>& choices);

/// A span of time, or several, that do not start before 0; none where the key is absent.
TimeWindow parse_window(TomlReader& reader, std::string_view key);
std::vector<TimeWindow> parse_windows(TomlReader& reader, std::string_view key);

/// Appends the rows of one [[acceptance]] group; the case's sensors and solvers must be there already.
void parse_acceptance_group(TomlReader& reader, Case& c);

void parse_published(TomlReader reader, Case& c);

}  // namespace sluice::case_parse
