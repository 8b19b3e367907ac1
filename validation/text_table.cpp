#include "validation/text_table.h"

#include <fmt/format.h>
#include <libfccp/csv.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sluice {

namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Takes the first field off `rest`; `more` tells whether another follows, so that "1," has two fields.
std::string_view take_field(std::string_view& rest, char separator, bool& more) {
  const auto end = separator == ' ' ? rest.find_first_of(blanks) : rest.find(separator);
  more = end != std::string_view::npos;
  const auto field = rest.substr(0, end);
  rest = more ? rest.substr(end + 1) : std::string_view{};
  if (separator == ' ') rest = trimmed(rest);
  return trimmed(field);
}

std::unique_ptr<io::LineReader> open_lines(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("{}: is a directory; name the file in it", path.string()));
  }
  try {
    return std::make_unique<io::LineReader>(path.string());
  } catch (const io::error::can_not_open_file& error) {
    throw std::runtime_error(fmt::format("{}: cannot be opened ({}); check the path and the permissions", path.string(),
                                         std::generic_category().message(error.errno_value)));
  }
}

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char separator) {
  std::vector<std::string> fields;
  auto rest = trimmed(line);
  for (bool more = !rest.empty(); more;) fields.emplace_back(take_field(rest, separator, more));
  return fields;
}

TextTableReader::TextTableReader(std::filesystem::path path) : path_(std::move(path)), lines_(open_lines(path_)) {}

TextTableReader::~TextTableReader() = default;

void TextTableReader::fail(const std::string& message) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", path_.string(), lines_->get_file_line(), message));
}

std::string TextTableReader::next_header_line() {
  const bool first = lines_->get_file_line() == 0;
  const char* line = lines_->next_line();
  if (line) return line;
  if (first) throw std::runtime_error(fmt::format("{}: the file is empty; it needs a header line", path_.string()));
  fail("the file ends within its header");
}

double TextTableReader::number(std::string_view field, const std::string& name) const {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range) fail(fmt::format("{}: \"{}\" does not fit a double", name, field));
  if (error != std::errc{} || end != field.data() + field.size()) {
    fail(fmt::format("{}: \"{}\" is not a number; write numbers with a decimal point, and leave nothing empty", name,
                     field));
  }
  if (!std::isfinite(value)) fail(fmt::format("{}: {} is not finite; leave the row out", name, field));
  return value;
}

void TextTableReader::read_row(std::string_view line, const std::vector<std::string>& names, char separator) {
  std::size_t count = 0;
  auto rest = trimmed(line);
  for (bool more = true; more; ++count) {
    const auto field = take_field(rest, separator, more);
    if (count < names.size()) columns_[count].push_back(number(field, names[count]));
  }
  if (count != names.size()) {
    fail(fmt::format("{} fields where {} columns are named; a line cut off at the end of the file can be deleted",
                     count, names.size()));
  }
}

void TextTableReader::check_time(const std::vector<double>& times, const std::string& name) const {
  const auto n = times.size();
  if (n < 2 || times[n - 1] > times[n - 2]) return;
  fail(fmt::format("{}: {} does not come after {} of the row before; sort the rows by time and drop repeated ones",
                   name, times[n - 1], times[n - 2]));
}

std::vector<std::vector<double>> TextTableReader::read_rows(const std::vector<std::string>& names, char separator,
                                                            std::size_t time_index) {
  columns_.assign(names.size(), {});
  bool blank_seen = false;
  while (const char* text = lines_->next_line()) {
    const std::string_view line = trimmed(text);
    if (line.empty()) {
      blank_seen = true;
      continue;
    }
    if (blank_seen) fail("a row after a blank line; delete blank lines between rows");
    read_row(line, names, separator);
    check_time(columns_.at(time_index), names[time_index]);
  }
  return std::exchange(columns_, {});
}

}  // namespace sluice
