// Results of another code in files of its own form, and the small map that says which of their columns is which sensor.
//
//   case = "kleefsman"
//   solver = "interFoam"                  # as it shall stand in tables
//   l0_m = 0.02                           # particle distance or mesh width
//   alpha = 0.01                          # where it has one; likewise walls = "..." and, of its run, wall_time_s,
//                                         # cpu_time_s, threads and steps: studies of alpha and of cost use them
//   [[files]]                             # one or several
//   file = "gauges.csv"                   # relative to the map
//   separator = ";"                       # "," (default), ";", "tab" or "blank"
//   decimal_comma = true                  # default: false
//   skip_incomplete_rows = true           # default: false, an empty or NaN field is an error
//   header_lines = 1                      # default 1; the last of them names the columns; 0: they have numbers
//   time = { column = "Time [s]", unit = "s", offset_s = 0.0 }
//   columns = [ { sensor = "P1", column = "Press_0", unit = "kPa", offset = 0.0 } ]
//
// A column is named as in the header line, without quotes, or counted from 1 on. Where the header has another number of
// names than the rows have fields (a title, blanks in names between blanks) they have numbers only; a comment ("#
// Time") keeps its first name where it has fewer. A field may stand in quotes, a row may end with a separator, and
// exponents may begin with d or D. Values become SI; `offset` is added first, in the column's own unit. Series of
// several files are joined at all their times within what all of them cover; a file that has a gap there is refused.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.h"
#include "validation/series.h"

namespace sluice {

struct ForeignColumn {
  std::string column;  ///< its name or, as digits, its number from 1 on
  double factor = 1;   ///< to the SI unit
  double offset = 0;   ///< added before, in the column's unit
  std::string target;  ///< column of probes.csv, such as "P1_Pa"; empty for time
};

struct ForeignFile {
  std::filesystem::path file;
  char separator = ',';
  bool decimal_comma = false;
  bool skip_incomplete_rows = false;
  int header_lines = 1;
  ForeignColumn time;
  std::vector<ForeignColumn> columns;
};

/// What a map may tell of a run beside its series: the same names as in run.json.
inline constexpr std::array<const char*, 5> foreign_numbers{"alpha", "wall_time_s", "cpu_time_s", "threads", "steps"};

struct ForeignMap {
  std::filesystem::path map;
  std::string case_name;
  std::string case_file;  ///< outside_case_file()
  std::string solver;
  double l0_m = 0;
  std::string walls;                      ///< empty: not told
  std::map<std::string, double> numbers;  ///< of foreign_numbers, those that the map has
  std::vector<ForeignFile> files;
};

/// Throws CaseError `file:line: key: message`: unknown keys, sensors that the case has not, units that do not fit.
ForeignMap load_foreign_map(const std::filesystem::path& map);

/// The same from text; `map` is what messages call it, and its folder that of the files.
ForeignMap parse_foreign_map(std::string_view text, const std::filesystem::path& map);

/// Reads the files into one table: every time of every file within what all of them cover. `warnings` says what was
/// left out. Throws std::runtime_error `file:line: message`: no such file or column, not a number, times that do not
/// increase, rows of another length.
ProbeTable read_foreign(const ForeignMap& map, std::vector<std::string>* warnings = nullptr);

/// The same with `texts`, one for each of the map's files, in their place.
ProbeTable parse_foreign(const ForeignMap& map, std::span<const std::string_view> texts);

/// Writes a run directory (run.json, probes.csv) that every report takes. Throws as above.
void import_foreign(const ForeignMap& map, const std::filesystem::path& directory);

}  // namespace sluice
