// The description of a digest: source.toml.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "validation/digest.h"
#include "validation/printable.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr int most_columns = 10'000;
constexpr double longest_smoothing_s = 100;

bool fits_header(const std::string& text) {
  return text.find_first_of(",;\" ") == std::string::npos && printable(text, text.size()) == text;
}

DigestColumn read_column(TomlReader& table) {
  DigestColumn column;
  column.number = table.integer("number");
  column.raw_name = table.text("raw_name");
  column.name = table.text("name");
  column.unit = table.text("unit");
  column.scale = table.number_or("scale", 1);
  column.mean_decimals = table.integer("mean_decimals");
  column.extreme_decimals = table.integer("extreme_decimals");
  table.finish();
  if (!fits_header(column.name) || column.name.find('_') != std::string::npos)
    table.fail("name", "has an underscore, separator, quote or blank (it becomes part of a column's name)");
  if (!fits_header(column.unit) || (column.unit.find('_') != std::string::npos && column.unit != "m_s"))
    table.fail("unit",
               "has an underscore, separator, quote or blank, and is not m_s (it becomes part of a column's name)");
  if (column.number < 1) table.fail("number", "columns are counted from 1");
  if (column.mean_decimals < 0 || column.mean_decimals > 15) table.fail("mean_decimals", "must lie between 0 and 15");
  if (column.extreme_decimals < 0 || column.extreme_decimals > 15) {
    table.fail("extreme_decimals", "must lie between 0 and 15");
  }
  return column;
}

char read_separator(TomlReader& table) {
  const auto word = table.text("separator");
  if (word == "blank") return ' ';
  if (word == "comma") return ',';
  if (word == "semicolon") return ';';
  if (word == "tab") return '\t';
  table.fail("separator", fmt::format("\"{}\" is not known; write blank, comma, semicolon or tab", word));
}

RawFile read_file(TomlReader& table) {
  RawFile file;
  file.file = table.text("raw_file");
  file.hash = table.text_or("raw_hash", "");
  file.header_lines = table.integer("header_lines");
  if (file.header_lines < 0) table.fail("header_lines", "is negative");
  file.header = table.text_or("header", "");
  file.separator = read_separator(table);
  return file;
}

/// One file stands at the root, several as tables.
std::vector<RawFile> read_files(TomlReader& root, bool scatter) {
  if (!root.has("files")) return {read_file(root)};
  std::vector<RawFile> files;
  for (auto& table : root.tables("files")) {
    files.push_back(read_file(table));
    table.finish();
  }
  if (files.size() > 1 && !scatter)
    root.fail("files", "samples of several recordings cannot be put together; say scatter = true if they are points");
  return files;
}

void read_columns(TomlReader& reader, DigestSource& source) {
  for (auto& table : reader.tables("columns")) {
    DigestColumn column = read_column(table);
    if (column.number > source.column_count)
      table.fail("number", fmt::format("the raw file has column_count = {} columns", source.column_count));
    for (const DigestColumn& other : source.columns)
      if (other.name == column.name) table.fail("name", fmt::format("`{}` occurs twice", column.name));
    source.columns.push_back(std::move(column));
  }
}

}  // namespace

DigestSource load_digest_source(const fs::path& toml_path) {
  return parse_digest_source(read_text(toml_path, "a data folder has a source.toml that describes its raw files"),
                             toml_path);
}

DigestSource parse_digest_source(std::string_view text, const fs::path& toml_path) {
  const auto root = parse_toml(text, toml_path.string());
  TomlReader reader(root, toml_path.string());
  DigestSource source;
  source.scatter = reader.flag_or("scatter", false);
  source.files = read_files(reader, source.scatter);
  source.column_count = reader.integer("column_count");
  if (source.column_count < 1 || source.column_count > most_columns)
    reader.fail("column_count", fmt::format("must lie between 1 and {}", most_columns));
  source.time_column = reader.integer("time_column");
  source.time_scale = reader.has("time_scale") ? reader.positive_number("time_scale") : 1;
  source.bin_s = reader.positive_number("bin_s");
  source.smoothing_s = reader.has("smoothing_s") ? reader.positive_number("smoothing_s") : 0;
  if (source.smoothing_s > longest_smoothing_s)
    reader.fail("smoothing_s", fmt::format("is {}, must be {} s at most", source.smoothing_s, longest_smoothing_s));
  read_columns(reader, source);
  if (source.time_column < 1 || source.time_column > source.column_count) {
    reader.fail("time_column", fmt::format("must lie between 1 and column_count = {}", source.column_count));
  }
  reader.finish();
  return source;
}

std::vector<DigestPlan> digest_plans(const fs::path& data_folder) {
  constexpr std::string_view mark = "source.toml";
  std::vector<DigestPlan> plans;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(data_folder, ignored)) {
    std::string name = entry.path().filename().string();
    if (name != mark && !name.ends_with(".source.toml")) continue;
    name.resize(name.size() - mark.size());
    plans.push_back({entry.path(), data_folder / (name.empty() ? "digest.csv" : name + "csv")});
  }
  if (plans.empty())
    throw std::runtime_error(
        fmt::format("{}: no source.toml; name a data folder that describes raw files", data_folder.string()));
  std::sort(plans.begin(), plans.end(), [](const auto& a, const auto& b) { return a.digest < b.digest; });
  return plans;
}

std::vector<fs::path> raw_paths(const DigestSource& source, const fs::path& raw_root) {
  std::vector<fs::path> paths;
  for (const RawFile& file : source.files) paths.push_back(raw_root / file.file);
  return paths;
}

fs::path raw_data_folder() {
  const char* set = std::getenv("SLUICE_RAW_DATA");
  return set && *set ? fs::path(set) : fs::path("../shared/data");
}

}  // namespace sluice
