// Reads one TOML table strictly: wrong types, missing and unknown keys are errors that name file, line and key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/vec3.h"

// Forward declaration would have to repeat the library's inline namespace.
#include <toml++/toml.h>

namespace sluice {

/// Throws CaseError `file:line: key: message`.
[[noreturn]] void throw_case_error(const std::string& file, int line, std::string_view key, std::string_view message);

/// Throws CaseError `file:line: syntax: message`.
toml::table parse_toml(std::string_view text, const std::string& file);

/// The text of a file. Throws CaseError "file: cannot be read (remedy)".
std::string read_text(const std::filesystem::path& file, std::string_view remedy);

class TomlReader;
struct Case;

/// load_case(), for a file whose key `case` names it: throws CaseError at that key.
Case load_case_for(const TomlReader& reader, const std::string& name_or_path);

/// Remembers which keys were asked for, so that finish() can refuse the rest. The table must outlive the reader.
class TomlReader {
 public:
  /// `path` is the table's place in the file for messages ("geometry.fluid[0]"), empty for the root.
  TomlReader(const toml::table& table, std::string file, std::string path = "");

  bool has(std::string_view key);
  double number(std::string_view key);
  double positive_number(std::string_view key);
  double number_or(std::string_view key, double fallback);
  std::optional<double> optional_number(std::string_view key);
  int integer(std::string_view key);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  bool flag_or(std::string_view key, bool fallback);
  std::vector<double> numbers(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  /// Exactly two numbers, the first not above the second.
  std::pair<double, double> range(std::string_view key);
  /// An array of such pairs.
  std::vector<std::pair<double, double>> ranges(std::string_view key);
  Vec3d vec3(std::string_view key);

  TomlReader table(std::string_view key);
  /// An array of tables; at least one is required unless `may_be_absent`.
  std::vector<TomlReader> tables(std::string_view key, bool may_be_absent = false);
  /// Every entry of this table, all of them numbers.
  std::vector<std::pair<std::string, double>> all_numbers();

  /// Throws CaseError for the first key that nobody asked for.
  void finish() const;

  /// Throws CaseError at the key's line (the table's when it is absent).
  [[noreturn]] void fail(std::string_view key, std::string_view message) const;
  int line() const { return static_cast<int>(table_->source().begin.line); }
  const std::string& path() const { return path_; }

 private:
  const toml::node& require(std::string_view key, std::string_view what);
  double finite(const toml::node& node, std::string_view key) const;
  std::string path_to(std::string_view key) const;

  const toml::table* table_;
  std::string file_;
  std::string path_;
  std::vector<std::string> asked_;
};

}  // namespace sluice
