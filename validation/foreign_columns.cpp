#include "validation/foreign_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "validation/printable.h"

namespace sluice {

namespace {

/// Numbers for the columns that have no name.
void number_rest(std::vector<std::string>& names, std::size_t columns) {
  while (names.size() < columns) names.push_back(std::to_string(names.size() + 1));
}

}  // namespace

std::size_t index_of(const TextTableReader& reader, const std::vector<std::string>& names, const std::string& column) {
  if (const auto found = std::find(names.begin(), names.end(), column); found != names.end()) {
    if (std::find(found + 1, names.end(), column) != names.end())
      reader.fail(fmt::format("column \"{}\" occurs twice; give its number", column));
    return static_cast<std::size_t>(found - names.begin());
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
  if (error == std::errc{} && end == column.data() + column.size() && number >= 1 && number <= names.size())
    return number - 1;
  reader.fail(fmt::format("no column \"{}\"; there are {}: {} (is the separator right?)", printable(column),
                          names.size(), printable(fmt::format("{}", fmt::join(names, " | ")), 500)));
}

std::vector<std::string> column_names(TextTableReader& reader, const ForeignFile& f) {
  std::string line;
  for (int k = 0; k < f.header_lines; ++k) line = reader.next_header_line();
  std::vector<std::string> names;
  if (f.header_lines == 0) {
    number_rest(names, reader.count_fields(f.separator));
    return names;
  }
  const auto mark = line.find_first_not_of(" \t");
  const bool is_comment = mark != std::string::npos && (line[mark] == '#' || line[mark] == '%');
  names = split_fields(is_comment ? line.substr(mark + 1) : line, f.separator);
  while (f.separator == '\t' && !names.empty() && names.back().empty()) names.pop_back();  // tabs at its end
  for (std::string& name : names)
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  if (is_comment) {
    const std::size_t columns = reader.count_fields(f.separator);
    if (names.size() == columns + 1 && names.front().empty()) names.erase(names.begin());  // behind the comment's mark
    if (names.size() < columns) names.resize(std::min<std::size_t>(names.size(), 1));
    number_rest(names, columns);
  }
  return names;
}

}  // namespace sluice
