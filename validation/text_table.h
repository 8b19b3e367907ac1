// Tables of numbers in text files, comma- or blank-separated: the one reader behind probes, digests and raw measured
// files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace io {
class LineReader;
}

namespace sluice {

/// Splits a line; ' ' as separator stands for any run of blanks and tabs. Blanks around a field are dropped.
std::vector<std::string> split_fields(std::string_view line, char separator);

/// Reads header lines one by one, then all rows. Every error is a std::runtime_error that begins with "file:line: ".
class TextTableReader {
 public:
  /// Throws when the file cannot be opened.
  explicit TextTableReader(std::filesystem::path path);
  ~TextTableReader();

  /// Throws when the file ends before it; an empty file is called empty.
  std::string next_header_line();

  /// All rows as columns, one for each of `names` (which the error messages use). Blank lines are allowed at the end
  /// only. Throws when a row has another number of fields, a field is not a finite number, or times[time_index] do not
  /// increase.
  std::vector<std::vector<double>> read_rows(const std::vector<std::string>& names, char separator,
                                             std::size_t time_index);

  /// Throws "file:line: message" for the line last read.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void read_row(std::string_view line, const std::vector<std::string>& names, char separator);
  double number(std::string_view field, const std::string& name) const;
  void check_time(const std::vector<double>& times, const std::string& name) const;

  std::filesystem::path path_;
  std::unique_ptr<io::LineReader> lines_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace sluice
