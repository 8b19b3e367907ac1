#include "validation/text_table.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "validation/printable.h"

namespace sluice {

namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::size_t longest_line = 1 << 20;  // bytes
constexpr std::size_t longest_message = 1000;  // of what quotes a file

std::string_view trimmed(std::string_view text, std::string_view of = blanks) {
  const auto first = text.find_first_not_of(of);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(of) - first + 1);
}

/// A line without what surrounds its fields. Tabs that separate are not that: the first or last field may be empty.
std::string_view fields_of(std::string_view line, char separator) {
  return separator == '\t' ? trimmed(line, " \r") : trimmed(line);
}

/// Where the quotes end that `text` begins with, doubled ones being part of it; 0 where it begins with none.
std::size_t end_of_quotes(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos || text[first] != '"') return 0;
  auto last = text.find('"', first + 1);
  while (last != std::string_view::npos && text.substr(last + 1).starts_with('"')) last = text.find('"', last + 2);
  return last == std::string_view::npos ? 0 : last + 1;
}

std::string_view without_quotes(std::string_view field) {
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

/// Takes the first field off `rest`; `more` tells whether another follows, so that "1," has two fields.
std::string_view take_field(std::string_view& rest, char separator, bool quotes, bool& more) {
  const auto from = quotes ? end_of_quotes(rest) : 0;
  const auto end = separator == ' ' ? rest.find_first_of(blanks, from) : rest.find(separator, from);
  more = end != std::string_view::npos;
  const auto field = trimmed(rest.substr(0, end));
  rest = more ? rest.substr(end + 1) : std::string_view{};
  if (separator == ' ') rest = trimmed(rest);
  return quotes ? without_quotes(field) : field;
}

/// Reads a number that is all of the field; Fortran's double precision has exponents like D-03.
std::errc number_in_field(std::string_view field, double& value) {
  const char* const last = field.data() + field.size();
  auto [end, error] = std::from_chars(field.data(), last, value);
  if (error == std::errc{} && end != last && (*end == 'D' || *end == 'd')) {
    std::string with_e(field);
    with_e[static_cast<std::size_t>(end - field.data())] = 'e';
    const char* const its_last = with_e.data() + with_e.size();
    const auto [its_end, its_error] = std::from_chars(with_e.data(), its_last, value);
    return its_error == std::errc{} && its_end != its_last ? std::errc::invalid_argument : its_error;
  }
  return error == std::errc{} && end != last ? std::errc::invalid_argument : error;
}

bool is_gap(std::string_view field) {
  return field.empty() || field == "nan" || field == "NaN" || field == "NAN" || field == "-nan";
}

/// What to do about a field that is no number. Two separators in one file, or another one than was announced, leave
/// theirs in a field.
std::string_view remedy_of(std::string_view field) {
  if (field.find_first_of(";\t ") != std::string_view::npos)
    return "it holds a separator: write one and the same between all columns";
  if (field.find(',') != std::string_view::npos)
    return "write numbers with a decimal point, or announce decimal commas";
  return "write numbers with a decimal point, and leave nothing empty";
}

std::unique_ptr<std::istream> open_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("{}: is a directory; name the file in it", path.string()));
  }
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) {
    throw std::runtime_error(fmt::format("{}: cannot be opened ({}); check the path and the permissions", path.string(),
                                         std::generic_category().message(errno)));
  }
  return file;
}

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char separator, bool quotes) {
  std::vector<std::string> fields;
  auto rest = fields_of(line, separator);
  for (bool more = !rest.empty(); more;) fields.emplace_back(take_field(rest, separator, quotes, more));
  return fields;
}

void rescale(std::vector<double>& values, double offset, double factor, const std::filesystem::path& file,
             const std::string& name) {
  for (double& value : values) {
    value = (value + offset) * factor;
    if (!std::isfinite(value))
      throw std::runtime_error(
          fmt::format("{}: {}: a value does not stay finite with offset {} and factor {}; are they "
                      "right?",
                      file.string(), printable(name), offset, factor));
  }
}

void rescale_times(std::vector<double>& times, double offset, double factor, const std::filesystem::path& file,
                   const std::string& name) {
  rescale(times, offset, factor, file, name);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw std::runtime_error(
          fmt::format("{}: {}: times do not stay apart with offset {} and factor {}; are they right?", file.string(),
                      printable(name), offset, factor));
}

TextTableReader::TextTableReader(std::filesystem::path path) : path_(std::move(path)), in_(open_file(path_)) {}

TextTableReader::TextTableReader(std::filesystem::path path, std::string_view text)
    : path_(std::move(path)), in_(std::make_unique<std::istringstream>(std::string(text))) {}

TextTableReader::~TextTableReader() = default;

void TextTableReader::fail(const std::string& message) const {
  fail_at(ahead_ && line_number_ > 1 ? line_number_ - 1 : line_number_, message);
}

void TextTableReader::fail_ahead(const std::string& message) const {
  fail_at(line_number_, message);
}

void TextTableReader::fail_at(std::size_t line_number, const std::string& message) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", path_.string(), line_number, printable(message, longest_message)));
}

std::string TextTableReader::next_header_line() {
  const bool first = line_number_ == 0;
  if (next_line()) return line_;
  if (first) throw std::runtime_error(fmt::format("{}: the file is empty; it needs a header line", path_.string()));
  fail("the file ends within its header (is it cut short, or has it fewer header lines than announced?)");
}

bool TextTableReader::take_line() {
  line_.clear();
  for (std::array<char, 4096> piece;; in_->clear()) {  // not cleared: 4 kB a row
    in_->getline(piece.data(), piece.size());
    const auto count = static_cast<std::size_t>(in_->gcount());
    if (in_->bad())
      throw std::runtime_error(fmt::format("{}: cannot be read to its end; check the disk", path_.string()));
    line_.append(piece.data(), in_->good() ? count - 1 : count);  // the line's end counts
    if (!in_->fail() || in_->eof()) return count > 0 || !line_.empty();
    if (line_.size() > longest_line) fail("the next line is longer than a megabyte; this is no table of numbers");
  }
}

bool TextTableReader::next_line() {
  if (std::exchange(ahead_, false)) return true;
  if (!take_line()) return false;
  if (++line_number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  if (line_.ends_with('\r')) line_.pop_back();
  if (line_.find('\0') != std::string::npos)
    fail("a NUL byte: this is no plain text (UTF-16 or binary?); save the file as text in UTF-8");
  return true;
}

std::vector<std::string> TextTableReader::peek_fields(char separator, bool quotes) {
  if (line_number_ == 0)
    next_header_line();
  else if (!next_line())
    return {};
  ahead_ = true;
  if (trimmed(line_).empty()) return {};
  return split_fields(line_, separator, quotes);
}

double TextTableReader::number(std::string_view field, const std::string& name, bool decimal_comma) const {
  std::string with_point;
  if (decimal_comma && field.find('.') != std::string_view::npos)
    fail(fmt::format("{}: \"{}\" has a point where decimal commas were announced; write thousands without one", name,
                     printable(field)));
  if (decimal_comma && field.find(',') != std::string_view::npos) {
    with_point = field;
    with_point[with_point.find(',')] = '.';
    field = with_point;
  }
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0;
  const std::errc error = number_in_field(field, value);
  if (error == std::errc::result_out_of_range)
    fail(fmt::format("{}: \"{}\" does not fit a double", name, printable(field)));
  if (error != std::errc{})
    fail(fmt::format("{}: \"{}\" is not a number; {}", name, printable(field), remedy_of(field)));
  if (!std::isfinite(value)) fail(fmt::format("{}: {} is not finite; leave the row out", name, field));
  return value;
}

bool TextTableReader::read_row(std::string_view line, const std::vector<std::string>& names, const RowForm& form) {
  std::size_t count = 0;
  bool complete = true;
  row_.assign(names.size(), 0.0);
  auto rest = fields_of(line, form.separator);
  for (bool more = true; more; ++count) {
    const auto field = take_field(rest, form.separator, form.quotes, more);
    if (count == names.size() && field.empty() && (form.separator == '\t' ? trimmed(rest).empty() : !more))
      break;  // behind a separator at the row's end
    if (count >= names.size() || !wanted_[count]) continue;
    if (form.skip_incomplete && is_gap(field)) {
      complete = false;
    } else {
      row_[count] = number(field, names[count], form.decimal_comma);
    }
  }
  if (count != names.size()) {
    fail(fmt::format("{} fields where {} columns are named; {}", count, names.size(),
                     count > names.size() && form.separator == ','
                         ? "if numbers have decimal commas, columns need another separator"
                         : "a line cut off at the end of the file can be deleted"));
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
  while (next_line()) {
    if (trimmed(line_).empty()) {
      blank_seen = true;
      continue;
    }
    if (blank_seen) fail("a row after a blank line; delete blank lines between rows");
    if (!read_row(line_, names, form)) {
      ++skipped_;
      continue;
    }
    if (!form.any_order) check_time(columns_.at(time_index), names[time_index]);
  }
  return std::exchange(columns_, {});
}

}  // namespace sluice
