#include "validation/foreign_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>
#include <utility>

#include "validation/printable.h"

namespace sluice {

namespace {

/// Numbers for the columns that have no name.
void number_rest(std::vector<std::string>& names, std::size_t columns) {
  while (names.size() < columns) names.push_back(std::to_string(names.size() + 1));
}

/// Drops what tabs at a line's end leave empty.
void drop_last_tabs(std::vector<std::string>& fields, char separator) {
  while (separator == '\t' && !fields.empty() && fields.back().empty()) fields.pop_back();
}

/// The header's names; `is_comment` tells whether they stood behind a comment's mark.
std::vector<std::string> names_in(const std::string& line, char separator, bool& is_comment) {
  const auto mark = line.find_first_not_of(" \t");
  is_comment = mark != std::string::npos && (line[mark] == '#' || line[mark] == '%');
  auto names = split_fields(is_comment ? line.substr(mark + 1) : line, separator, true);
  drop_last_tabs(names, separator);
  return names;
}

/// Whether a row has a field for each name, and none behind them but what the reader drops there.
bool fit(const std::vector<std::string>& names, const std::vector<std::string>& row, char separator) {
  if (names.size() >= row.size()) return names.size() == row.size();
  const auto behind = row.begin() + static_cast<std::ptrdiff_t>(names.size());
  return (separator == '\t' || names.size() + 1 == row.size()) &&
         std::all_of(behind, row.end(), [](const std::string& field) { return field.empty(); });
}

/// The names as they may be meant: a separator behind a comment's mark or at the header's end leaves an empty one.
std::vector<std::vector<std::string>> readings(const std::vector<std::string>& names, bool is_comment) {
  std::vector<std::vector<std::string>> all;
  if (is_comment && !names.empty() && names.front().empty()) all.emplace_back(names.begin() + 1, names.end());
  all.push_back(names);
  if (!names.empty() && names.back().empty()) all.emplace_back(names.begin(), names.end() - 1);
  return all;
}

[[noreturn]] void fail_without_names(const TextTableReader& reader, const ColumnNames& columns,
                                     const std::string& column) {
  const std::size_t fields = columns.names.size();
  reader.fail_ahead(
      fmt::format("{} fields where the header has {} names, so that none can be told to be \"{}\"; give columns by "
                  "their numbers, 1 to {}, or mend the header{}",
                  fields, columns.left_out, printable(column), fields,
                  fields > columns.left_out ? " (if numbers have decimal commas, columns need another separator)"
                                            : " (are `separator` and `header_lines` right?)"));
}

}  // namespace

std::size_t index_of(const TextTableReader& reader, const ColumnNames& columns, const std::string& column) {
  const std::vector<std::string>& names = columns.names;
  if (const auto found = std::find(names.begin(), names.end(), column); found != names.end()) {
    if (std::find(found + 1, names.end(), column) != names.end())
      reader.fail(fmt::format("column \"{}\" occurs twice; give its number", column));
    return static_cast<std::size_t>(found - names.begin());
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
  if (error == std::errc{} && end == column.data() + column.size() && number >= 1 && number <= names.size())
    return number - 1;
  if (columns.left_out > 0) fail_without_names(reader, columns, column);
  reader.fail(fmt::format("no column \"{}\"; there are {}: {} (is the separator right?)", printable(column),
                          names.size(), printable(fmt::format("{}", fmt::join(names, " | ")), 500)));
}

ColumnNames column_names(TextTableReader& reader, const ForeignFile& f) {
  std::string line;
  for (int k = 0; k < f.header_lines; ++k) line = reader.next_header_line();
  std::vector<std::string> row = reader.peek_fields(f.separator, true);
  ColumnNames columns;
  bool is_comment = false;
  if (f.header_lines > 0) {
    columns.names = names_in(line, f.separator, is_comment);
    if (row.empty()) return columns;
    for (auto& names : readings(columns.names, is_comment))
      if (fit(names, row, f.separator)) return {std::move(names), 0};
  }
  drop_last_tabs(row, f.separator);
  auto& names = columns.names;
  const bool first_is_named = is_comment && !names.empty() && names.size() < row.size();
  if (!first_is_named) columns.left_out = names.size();
  names.resize(first_is_named ? 1 : 0);
  number_rest(names, row.size());
  return columns;
}

}  // namespace sluice
