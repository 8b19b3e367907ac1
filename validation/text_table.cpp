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

bool is_gap(std::string_view field) {
  return field.empty() || field == "nan" || field == "NaN" || field == "NAN" || field == "-nan";
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

const char* TextTableReader::next_line() {
  if (std::exchange(has_ahead_, false)) return ahead_.c_str();
  return lines_->next_line();
}

std::size_t TextTableReader::count_fields(char separator) {
  ahead_ = next_header_line();
  has_ahead_ = true;
  return split_fields(ahead_, separator).size();
}

double TextTableReader::number(std::string_view field, const std::string& name, bool decimal_comma) const {
  std::string with_point;
  if (decimal_comma && field.find(',') != std::string_view::npos) {
    if (field.find('.') != std::string_view::npos)
      fail(fmt::format("{}: \"{}\" has a point where decimal commas were announced", name, field));
    with_point = field;
    with_point[with_point.find(',')] = '.';
    field = with_point;
  }
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

bool TextTableReader::read_row(std::string_view line, const std::vector<std::string>& names, const RowForm& form) {
  std::size_t count = 0;
  bool complete = true;
  row_.assign(names.size(), 0.0);
  auto rest = trimmed(line);
  for (bool more = true; more; ++count) {
    const auto field = take_field(rest, form.separator, more);
    if (count >= names.size() || !wanted_[count]) continue;
    if (form.skip_incomplete && is_gap(field)) {
      complete = false;
    } else {
      row_[count] = number(field, names[count], form.decimal_comma);
    }
  }
  if (count != names.size()) {
    fail(fmt::format("{} fields where {} columns are named; a line cut off at the end of the file can be deleted",
                     count, names.size()));
  }
  if (!complete) return false;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (wanted_[k]) columns_[k].push_back(row_[k]);
  return true;
}

void TextTableReader::check_time(const std::vector<double>& times, const std::string& name) const {
  const auto n = times.size();
  if (n < 2 || times[n - 1] > times[n - 2]) return;
  fail(fmt::format("{}: {} does not come after {} of the row before; sort the rows by time and drop repeated ones",
                   name, times[n - 1], times[n - 2]));
}

std::vector<std::vector<double>> TextTableReader::read_rows(const std::vector<std::string>& names, char separator,
                                                            std::size_t time_index) {
  return read_rows(names, RowForm{separator}, time_index);
}

std::vector<std::vector<double>> TextTableReader::read_rows(const std::vector<std::string>& names, const RowForm& form,
                                                            std::size_t time_index) {
  columns_.assign(names.size(), {});
  wanted_.assign(names.size(), form.wanted.empty());
  for (const std::size_t column : form.wanted) wanted_.at(column) = true;
  bool blank_seen = false;
  while (const char* text = next_line()) {
    const std::string_view line = trimmed(text);
    if (line.empty()) {
      blank_seen = true;
      continue;
    }
    if (blank_seen) fail("a row after a blank line; delete blank lines between rows");
    if (!read_row(line, names, form)) {
      ++skipped_;
      continue;
    }
    if (!form.any_order) check_time(columns_.at(time_index), names[time_index]);
  }
  return std::exchange(columns_, {});
}

}  // namespace sluice
