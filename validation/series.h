// Time series as they stand in a run directory's probes.csv: reading, and writing while a run goes on.
// Header: `t_s,<name>_<unit>,...`; one row a sample, times strictly increasing, every value finite.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

/// One quantity over time. `t_s` and `value` have equal length; times increase strictly but need not be evenly spaced.
struct Series {
  std::string name;  ///< without the unit, such as "P1_wall"
  std::string unit;  ///< such as "Pa"; "1" for a pure number
  std::vector<double> t_s;
  std::vector<double> value;
};

/// A column's header split at its last underscore: "P1_wall_Pa" is {"P1_wall", "Pa"}; without underscore the unit is
/// empty.
struct ColumnName {
  std::string name;
  std::string unit;
};
ColumnName split_column_name(std::string_view header);

/// Several columns over the same times.
class ProbeTable {
 public:
  ProbeTable() = default;
  /// `names` are full headers such as "P1_Pa"; `columns[k]` belongs to `names[k]` and is as long as `t_s`.
  /// Throws std::invalid_argument when lengths differ or a name occurs twice.
  ProbeTable(std::filesystem::path path, std::vector<std::string> names, std::vector<double> t_s,
             std::vector<std::vector<double>> columns);

  const std::filesystem::path& path() const { return path_; }
  /// Full headers in the file's order, without "t_s".
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<double>& times_s() const { return t_s_; }
  std::size_t rows() const { return t_s_.size(); }
  bool has(std::string_view full_name) const;
  /// Throws std::out_of_range naming the file and the columns that it has.
  const std::vector<double>& values(std::string_view full_name) const;
  /// A copy of one column with its times; throws as values() does.
  Series column(std::string_view full_name) const;

 private:
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<double> t_s_;
  std::vector<std::vector<double>> columns_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

/// Reads a probes.csv. A header without rows is an empty table (a run that has just started).
/// Throws std::runtime_error "file:line: column: what is wrong; remedy" on anything else that is not a clean table: no
/// such file, empty file, first column not t_s, wrong number of fields, not a number, NaN or infinity, times not
/// increasing.
ProbeTable read_probes(const std::filesystem::path& path);

/// The same from text; `path` is what messages call it.
ProbeTable parse_probes(std::string_view text, const std::filesystem::path& path);

/// Writes a whole table; throws as ProbeWriter does.
void write_probes(const std::filesystem::path& path, const ProbeTable& table);

/// Appends rows to a new probes.csv while a run goes on. Whole rows reach the file about once a second and on close, so
/// that a run that is killed loses at most its last second and never leaves half a row.
class ProbeWriter {
 public:
  /// How far a file had come.
  struct Position {
    std::uintmax_t bytes = 0;
    std::int64_t rows = 0;
    double last_t_s = 0;
  };

  /// `names` are full headers without "t_s". Creates or overwrites the file; throws std::runtime_error if it cannot.
  ProbeWriter(std::filesystem::path path, std::vector<std::string> names);
  /// Goes on with a file from where it once was: what stands behind is cut off. Throws std::runtime_error when the file
  /// is missing, shorter than that, or has other columns.
  ProbeWriter(std::filesystem::path path, std::vector<std::string> names, const Position& from);
  ~ProbeWriter();
  ProbeWriter(const ProbeWriter&) = delete;
  ProbeWriter& operator=(const ProbeWriter&) = delete;

  /// One row; `values` in the order of the names. Throws std::invalid_argument when the number of values is wrong or
  /// the time does not increase, std::runtime_error when a value is not finite (naming column and time) or the disk has
  /// taken nothing for as long as `patience`: until then rows wait in memory.
  void append(double t_s, std::span<const double> values);
  /// Throws std::runtime_error when the disk is full; the rows are not lost, a later flush may write them.
  void flush();
  /// Flushes, and returns when all of it would survive a power cut.
  void flush_to_disk();
  /// After a flush: where the file stands.
  Position position() const { return {bytes_on_disk_, rows_, last_t_s_}; }
  /// Flushes and closes; the destructor does the same but cannot report an error.
  void close();
  std::int64_t rows() const { return rows_; }
  /// What keeps rows from being written, or "".
  const std::string& trouble() const { return trouble_; }

  /// How long rows wait for a disk that is full before append() gives up.
  std::chrono::steady_clock::duration patience = std::chrono::minutes{10};

 private:
  void write_buffer();
  bool flush_is_due() const;

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  std::string trouble_;
  std::uintmax_t bytes_on_disk_ = 0;
  std::chrono::steady_clock::time_point last_flush_;
  std::chrono::steady_clock::time_point trouble_since_;  ///< where there is one: of the first write that failed
  double last_t_s_ = 0;
  std::int64_t rows_ = 0;
};

}  // namespace sluice
