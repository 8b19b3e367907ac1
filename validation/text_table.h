// Tables of numbers in text files, comma- or blank-separated: the one reader behind probes, digests and raw measured
// files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

/// Splits a line; ' ' as separator stands for any run of blanks and tabs. Blanks around a field are dropped. With
/// `quotes` so is a pair of quotes around it, between which a separator is part of the field.
std::vector<std::string> split_fields(std::string_view line, char separator, bool quotes = false);

/// value = (value + offset) * factor. Throws std::runtime_error "file: name: ..." when a value does not stay finite.
void rescale(std::vector<double>& values, double offset, double factor, const std::filesystem::path& file,
             const std::string& name);
/// The same; throws also when the times do not stay apart.
void rescale_times(std::vector<double>& times, double offset, double factor, const std::filesystem::path& file,
                   const std::string& name);

/// How the rows of a file are written.
struct RowForm {
  char separator = ',';
  bool decimal_comma = false;
  bool quotes = false;                   ///< as split_fields has them
  std::vector<std::size_t> wanted = {};  ///< columns that are read, others may hold anything; none: all
  bool skip_incomplete = false;          ///< rows in which a wanted field is empty or NaN are left out and counted
  bool any_order = false;                ///< times need not increase
};

/// Reads header lines one by one, then all rows. Every error is a std::runtime_error that begins with "file:line: ".
class TextTableReader {
 public:
  /// Throws when the file cannot be opened.
  explicit TextTableReader(std::filesystem::path path);
  /// Reads `text` as if it stood in the file.
  TextTableReader(std::filesystem::path path, std::string_view text);
  ~TextTableReader();

  /// Throws when the file ends before it; an empty file is called empty.
  std::string next_header_line();

  /// All rows as columns, one for each of `names` (which the error messages use). Blank lines are allowed at the end
  /// only. An exponent may begin with d or D, as Fortran writes it. Throws when a row has another number of fields (one
  /// separator or any number of tabs at its end apart), a field is not a finite number, or times[time_index] do not
  /// increase.
  std::vector<std::vector<double>> read_rows(const std::vector<std::string>& names, char separator,
                                             std::size_t time_index);
  /// The same for rows of another form; columns that are not wanted come back empty.
  std::vector<std::vector<double>> read_rows(const std::vector<std::string>& names, const RowForm& form,
                                             std::size_t time_index);
  /// Fields of the next line, which is not consumed; none where there is no such line or it is blank. Throws where the
  /// file is empty.
  std::vector<std::string> peek_fields(char separator, bool quotes);
  /// Rows that were left out.
  std::int64_t skipped() const { return skipped_; }

  /// Throws "file:line: message" for the line last read.
  [[noreturn]] void fail(const std::string& message) const;
  /// The same for a line whose fields were looked at since.
  [[noreturn]] void fail_ahead(const std::string& message) const;

 private:
  /// Puts the next line as it stands into line_; false when there is none.
  bool take_line();
  /// The same, without what is no text in it.
  bool next_line();
  /// False when the row is left out.
  bool read_row(std::string_view line, const std::vector<std::string>& names, const RowForm& form);
  [[noreturn]] void fail_at(std::size_t line_number, const std::string& message) const;
  double number(std::string_view field, const std::string& name, bool decimal_comma) const;
  void check_time(const std::vector<double>& times, const std::string& name) const;

  std::filesystem::path path_;
  std::unique_ptr<std::istream> in_;
  std::string line_;
  std::size_t line_number_ = 0;
  bool ahead_ = false;  ///< line_ was looked at before its time
  std::vector<std::vector<double>> columns_;
  std::vector<bool> wanted_;
  std::vector<double> row_;
  std::int64_t skipped_ = 0;
};

}  // namespace sluice
