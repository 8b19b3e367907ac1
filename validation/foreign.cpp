#include "validation/foreign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "validation/curve.h"
#include "validation/file_error.h"
#include "validation/file_hash.h"
#include "validation/foreign_columns.h"
#include "validation/manifest.h"
#include "validation/metrics.h"
#include "validation/printable.h"
#include "validation/suggest.h"
#include "validation/text_table.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, double> time_units{{"s", 1}, {"ms", 1e-3}};
const std::map<std::string, double> pressure_units{{"Pa", 1},    {"hPa", 100}, {"mbar", 100},
                                                   {"kPa", 1e3}, {"bar", 1e5}, {"MPa", 1e6}};
const std::map<std::string, double> length_units{{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}};

const std::map<std::string, double> force_units{{"N", 1}, {"kN", 1e3}, {"mN", 1e-3}};
const std::map<std::string, double> velocity_units{{"m/s", 1}, {"cm/s", 1e-2}, {"mm/s", 1e-3}};

const std::map<std::string, double>& units_of(SensorKind kind) {
  switch (kind) {
    case SensorKind::pressure:
      return pressure_units;
    case SensorKind::force:
      return force_units;
    case SensorKind::velocity:
      return velocity_units;
    case SensorKind::wave_height:
      break;
  }
  return length_units;
}

double factor_of(TomlReader& reader, const std::map<std::string, double>& units) {
  const std::string unit = reader.text("unit");
  if (const auto found = units.find(unit); found != units.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, factor] : units) known.push_back(name);
  reader.fail("unit", fmt::format("`{}` is not one of {}", unit, fmt::join(known, ", ")));
}

ForeignColumn parse_time(TomlReader reader) {
  ForeignColumn time;
  time.column = reader.text("column");
  time.factor = factor_of(reader, time_units);
  time.offset = reader.number_or("offset_s", 0) / time.factor;
  reader.finish();
  return time;
}

ForeignColumn parse_column(TomlReader& reader, const Case& c) {
  const std::string name = reader.text("sensor");
  const CaseSensor* sensor = c.find_sensor(name);
  if (sensor == nullptr) {
    std::vector<std::string> known;
    for (const CaseSensor& s : c.sensors) known.push_back(s.name);
    reader.fail("sensor",
                fmt::format("the case {} has no sensor `{}`; it has {}", c.name, name, fmt::join(known, ", ")));
  }
  ForeignColumn column;
  column.column = reader.text("column");
  column.factor = factor_of(reader, units_of(sensor->kind));
  column.offset = reader.number_or("offset", 0);
  column.target = probe_column(*sensor);
  reader.finish();
  return column;
}

char parse_separator(TomlReader& reader) {
  const std::string text = reader.text_or("separator", ",");
  if (text == "tab") return '\t';
  if (text == "blank") return ' ';
  if (text == "," || text == ";") return text[0];
  reader.fail("separator", fmt::format("`{}` is not one of \",\", \";\", \"tab\", \"blank\"", text));
}

ForeignFile parse_file(TomlReader& reader, const Case& c, const fs::path& folder) {
  ForeignFile f;
  const std::string name = reader.text("file");
  if (printable(name, name.size()) != name) reader.fail("file", "holds a control character; rename the file");
  f.file = folder / name;
  f.separator = parse_separator(reader);
  f.decimal_comma = reader.flag_or("decimal_comma", false);
  f.skip_incomplete_rows = reader.flag_or("skip_incomplete_rows", false);
  f.header_lines = reader.has("header_lines") ? reader.integer("header_lines") : 1;
  if (f.header_lines < 0) reader.fail("header_lines", "is negative");
  if (f.decimal_comma && f.separator == ',')
    reader.fail("decimal_comma",
                "commas cannot both separate columns and stand in numbers (say which separator it is)");
  f.time = parse_time(reader.table("time"));
  for (TomlReader& column : reader.tables("columns")) f.columns.push_back(parse_column(column, c));
  reader.finish();
  return f;
}

ProbeTable read_file(TextTableReader& reader, const ForeignFile& f, std::int64_t& skipped) {
  const ColumnNames found = column_names(reader, f);
  const std::size_t time = index_of(reader, found, f.time.column);
  std::vector<std::size_t> wanted{time};
  for (const ForeignColumn& column : f.columns) wanted.push_back(index_of(reader, found, column.column));
  RowForm form{f.separator, f.decimal_comma};
  form.quotes = true;
  form.wanted = wanted;
  form.skip_incomplete = f.skip_incomplete_rows;
  auto columns = reader.read_rows(found.names, form, time);
  skipped += reader.skipped();
  auto times = columns[time];  // a copy, as below: one column may feed time and sensors
  rescale_times(times, f.time.offset, f.time.factor, f.file, f.time.column);
  if (times.empty())
    throw std::runtime_error(fmt::format("{}: holds no row behind its header{}", f.file.string(),
                                         reader.skipped() > 0
                                             ? " that is complete (map only columns that it fills)"
                                             : " (is `header_lines` right, and was it written to its end?)"));
  std::vector<std::string> targets;
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < f.columns.size(); ++k) {
    targets.push_back(f.columns[k].target);
    values.push_back(columns[wanted[k + 1]]);
    rescale(values.back(), f.columns[k].offset, f.columns[k].factor, f.file, f.columns[k].column);
  }
  return {f.file, std::move(targets), std::move(times), std::move(values)};
}

/// All times of the tables within a window, sorted; of times that would be written alike, one.
std::vector<double> all_times(const std::vector<ProbeTable>& tables, Window window) {
  constexpr double written_alike = 1e-8;  // run directories keep nine digits
  std::vector<double> times;
  for (const ProbeTable& t : tables)
    for (const double time_s : t.times_s())
      if (time_s >= window.begin_s && time_s <= window.end_s) times.push_back(time_s);
  std::sort(times.begin(), times.end());
  const auto alike = [](double a, double b) { return b - a <= written_alike * std::max(std::abs(a), std::abs(b)); };
  times.erase(std::unique(times.begin(), times.end(), alike), times.end());
  return times;
}

/// Between the times of other files a hole would pass for a straight line.
void refuse_gap(const ProbeTable& table, Window window) {
  const auto gap = first_gap({table.times_s(), table.times_s()}, window);
  if (gap)
    fail(table.path(), fmt::format("has no rows between {:.6g} and {:.6g} s, where the other files of its map go on; "
                                   "complete it, or give it a map of its own, whose report then shows the gap",
                                   gap->begin_s, gap->end_s));
}

/// The series of all tables at all their times, over what all of them cover: no sample of any is lost.
ProbeTable joined(const ForeignMap& map, std::vector<ProbeTable> tables, std::vector<std::string>& warnings) {
  if (tables.size() == 1) return std::move(tables.front());
  Window all{tables.front().times_s().front(), tables.front().times_s().back()};
  Window shared = all;
  for (const ProbeTable& t : tables) {
    all = {std::min(all.begin_s, t.times_s().front()), std::max(all.end_s, t.times_s().back())};
    shared = {std::max(shared.begin_s, t.times_s().front()), std::min(shared.end_s, t.times_s().back())};
  }
  for (const ProbeTable& t : tables) refuse_gap(t, shared);
  std::vector<double> times = all_times(tables, shared);
  if (times.empty())
    throw std::runtime_error(fmt::format(
        "{}: its files have no time in common (are the units and offsets of time right?)", map.map.string()));
  if (shared.begin_s > all.begin_s || shared.end_s < all.end_s)
    warnings.push_back(
        fmt::format("its files cover {:.6g} to {:.6g} s together, all of them only {:.6g} to {:.6g} s, which was taken "
                    "(a map of its "
                    "own for each keeps all)",
                    all.begin_s, all.end_s, shared.begin_s, shared.end_s));
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  for (const ProbeTable& t : tables) {
    for (const std::string& name : t.names()) {
      names.push_back(name);
      columns.push_back(values_at({t.times_s(), t.values(name)}, times));
    }
  }
  return {map.map, std::move(names), std::move(times), std::move(columns)};
}

void refuse_repeated_sensors(const ForeignMap& map) {
  std::set<std::string> seen;
  for (const ForeignFile& f : map.files)
    for (const ForeignColumn& column : f.columns)
      if (!seen.insert(column.target).second)
        throw CaseError(fmt::format("{}: {} is given twice (one column a sensor)", map.map.string(), column.target));
}

}  // namespace

ForeignMap load_foreign_map(const fs::path& map) {
  return parse_foreign_map(read_text(map, "give the path of a map's TOML file"), map);
}

ForeignMap parse_foreign_map(std::string_view text, const fs::path& map) {
  const toml::table table = parse_toml(text, map.string());
  TomlReader reader(table, map.string());
  ForeignMap foreign;
  foreign.map = map;
  foreign.solver = reader.text("solver");
  foreign.l0_m = reader.positive_number("l0_m");
  if (reader.has("walls")) foreign.walls = reader.text("walls");
  for (const char* name : foreign_numbers)
    if (reader.has(name)) foreign.numbers[name] = reader.positive_number(name);
  const Case c = load_case_for(reader, reader.text("case"));
  foreign.case_name = c.name;
  foreign.case_file = outside_case_file(c);
  for (TomlReader& file : reader.tables("files")) foreign.files.push_back(parse_file(file, c, map.parent_path()));
  reader.finish();
  refuse_repeated_sensors(foreign);
  return foreign;
}

ProbeTable read_foreign(const ForeignMap& map, std::vector<std::string>* warnings) {
  std::vector<ProbeTable> tables;
  std::vector<std::string> noted;
  std::int64_t left_out = 0;
  for (const ForeignFile& f : map.files) {
    TextTableReader reader(f.file);
    tables.push_back(read_file(reader, f, left_out));
  }
  if (left_out > 0) noted.push_back(fmt::format("{} incomplete rows of its files were left out", left_out));
  ProbeTable table = joined(map, std::move(tables), noted);
  if (warnings != nullptr) *warnings = std::move(noted);
  return table;
}

ProbeTable parse_foreign(const ForeignMap& map, std::span<const std::string_view> texts) {
  if (texts.size() != map.files.size())
    throw std::invalid_argument(fmt::format("{} texts for {} files", texts.size(), map.files.size()));
  std::vector<ProbeTable> tables;
  std::int64_t left_out = 0;
  std::vector<std::string> ignored;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    TextTableReader reader(map.files[k].file, texts[k]);
    tables.push_back(read_file(reader, map.files[k], left_out));
  }
  return joined(map, std::move(tables), ignored);
}

void import_foreign(const ForeignMap& map, const fs::path& directory) {
  std::vector<std::string> warnings;
  const ProbeTable table = read_foreign(map, &warnings);
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: cannot be made ({}); check that no file is in its way and that the folder above is writable",
                    directory.string(), error.message()));
  write_probes(directory / "probes.csv", table);
  nlohmann::json sources = nlohmann::json::array();
  for (const ForeignFile& f : map.files)
    sources.push_back({{"file", f.file.filename().string()}, {"hash", file_hash(f.file)}});
  nlohmann::json manifest{{"case", map.case_name},    {"solver", map.solver}, {"l0_m", map.l0_m},
                          {"imported_from", sources}, {"warnings", warnings}, {"map_hash", file_hash(map.map)}};
  if (!map.walls.empty()) manifest["walls"] = map.walls;
  for (const auto& [name, value] : map.numbers) manifest[name] = value;
  if (!map.case_file.empty()) manifest["case_file"] = map.case_file;
  write_manifest(directory, manifest);
}

}  // namespace sluice
