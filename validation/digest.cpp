#include "validation/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include "validation/curve.h"
#include "validation/file_hash.h"
#include "validation/text_table.h"
#include "validation/toml_reader.h"

namespace sluice {

namespace {

/// A bin that the samples cover by less is left out: its mean would be that of another stretch of time.
constexpr double least_cover = 0.9;

toml::table parse_file(const std::filesystem::path& path) {
  try {
    return toml::parse_file(path.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
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

std::vector<std::string> column_labels(const DigestSource& source, std::size_t count) {
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < count; ++k) labels.push_back(fmt::format("column {}", k + 1));
  for (const auto& column : source.columns) {
    labels.at(static_cast<std::size_t>(column.number - 1)) += " (" + column.raw_name + ")";
  }
  return labels;
}

struct RawTable {
  std::vector<double> t_s;
  std::vector<std::vector<double>> values;  ///< one for each column of the description, scaled
};

RawTable read_raw(const DigestSource& source, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw std::runtime_error(
        fmt::format("{}: no such raw file; README.md beside the digest says where it comes from, and the "
                    "environment variable SLUICE_RAW_DATA names the folder of raw data",
                    path.string()));
  }
  if (!source.raw_hash.empty()) {
    const auto hash = file_hash(path);
    if (hash != source.raw_hash) {
      throw std::runtime_error(
          fmt::format("{}: its hash is {}, not {} of the file described; take that file, or describe "
                      "this one and drop raw_hash",
                      path.string(), hash, source.raw_hash));
    }
  }
  TextTableReader reader(path);
  std::string header;
  for (int k = 0; k < source.header_lines; ++k) header = reader.next_header_line();
  if (!source.header.empty() && header != source.header) {
    reader.fail(fmt::format("the header is not the one described (\"{}\"); the columns may differ", source.header));
  }
  auto columns = reader.read_rows(column_labels(source, static_cast<std::size_t>(source.column_count)),
                                  source.separator, static_cast<std::size_t>(source.time_column - 1));
  RawTable raw;
  raw.t_s = columns[static_cast<std::size_t>(source.time_column - 1)];
  for (double& t : raw.t_s) t *= source.time_scale;
  for (const auto& column : source.columns) {
    raw.values.push_back(columns[static_cast<std::size_t>(column.number - 1)]);
    for (double& value : raw.values.back()) value *= column.scale;
  }
  if (raw.t_s.size() < 2) throw std::runtime_error(fmt::format("{}: fewer than two rows", path.string()));
  return raw;
}

/// Bins k = first..last - 1 are [k bin_s, (k + 1) bin_s].
struct BinRange {
  long first = 0;
  long last = 0;
};

Window bin_edges(long k, double bin_s) {
  return {static_cast<double>(k) * bin_s, static_cast<double>(k + 1) * bin_s};
}

BinRange covered_bins(const std::vector<double>& t_s, double bin_s) {
  const Window samples{t_s.front(), t_s.back()};
  BinRange range{static_cast<long>(std::floor(t_s.front() / bin_s)),
                 static_cast<long>(std::floor(t_s.back() / bin_s)) + 1};
  if (shared_s(bin_edges(range.first, bin_s), samples) < least_cover * bin_s) ++range.first;
  if (shared_s(bin_edges(range.last - 1, bin_s), samples) < least_cover * bin_s) --range.last;
  return range;
}

/// Fixed decimals, and no "-0.00": two digests must not differ by the sign of nothing.
void append_number(std::string& out, double value, int decimals) {
  auto text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  out += ',';
  out += text;
}

std::span<const double> samples_in(const Curve& curve, Window edges, const std::string& name) {
  const auto first = first_at_or_after(curve, edges.begin_s);
  const auto last = first_at_or_after(curve, edges.end_s);
  if (first == last) {
    throw std::runtime_error(
        fmt::format("{}: no sample between {} and {} s; choose a wider bin_s", name, edges.begin_s, edges.end_s));
  }
  return curve.value.subspan(first, last - first);
}

/// One column of the raw file on its way into bins.
class ColumnDigest {
 public:
  ColumnDigest(const DigestColumn& column, Series samples, double smoothing_s)
      : column_(column),
        samples_(std::move(samples)),
        integral_(samples_),
        smoothing_s_(smoothing_s),
        smoothed_(smoothing_s > 0 ? running_mean(samples_, smoothing_s) : Series{}) {}
  ColumnDigest(const ColumnDigest&) = delete;  // the integral looks into the samples
  ColumnDigest& operator=(const ColumnDigest&) = delete;

  std::string header() const {
    auto text = fmt::format(",{0}_mean_{1},{0}_min_{1},{0}_max_{1}", column_.name, column_.unit);
    if (smoothing_s_ > 0) text += fmt::format(",{}_max{:.6g}ms_{}", column_.name, 1e3 * smoothing_s_, column_.unit);
    return text;
  }

  void append_bin(std::string& out, Window edges) const {
    const Window covered = clipped(samples_, edges);
    const double mean = integral_.between(covered.begin_s, covered.end_s) / (covered.end_s - covered.begin_s);
    const auto inside = samples_in(samples_, edges, column_.raw_name);
    const auto [low, high] = std::minmax_element(inside.begin(), inside.end());
    append_number(out, mean, column_.mean_decimals);
    append_number(out, *low, column_.extreme_decimals);
    append_number(out, *high, column_.extreme_decimals);
    if (smoothing_s_ <= 0) return;
    const auto smoothed = samples_in(smoothed_, edges, column_.raw_name);
    append_number(out, *std::max_element(smoothed.begin(), smoothed.end()), column_.extreme_decimals);
  }

 private:
  const DigestColumn& column_;
  Series samples_;
  CumulativeIntegral integral_;
  double smoothing_s_;
  Series smoothed_;
};

std::string digest_text(const DigestSource& source, const RawTable& raw) {
  std::string text = "t_s";
  std::vector<std::unique_ptr<ColumnDigest>> columns;
  for (std::size_t k = 0; k < source.columns.size(); ++k) {
    const auto& column = source.columns[k];
    columns.push_back(std::make_unique<ColumnDigest>(column, Series{column.name, column.unit, raw.t_s, raw.values[k]},
                                                     source.smoothing_s));
    text += columns.back()->header();
  }
  text += '\n';
  const BinRange range = covered_bins(raw.t_s, source.bin_s);
  for (long bin = range.first; bin < range.last; ++bin) {
    fmt::format_to(std::back_inserter(text), "{:.7g}", (static_cast<double>(bin) + 0.5) * source.bin_s);
    for (const auto& column : columns) column->append_bin(text, bin_edges(bin, source.bin_s));
    text += '\n';
  }
  return text;
}

}  // namespace

DigestSource load_digest_source(const std::filesystem::path& toml_path) {
  const auto root = parse_file(toml_path);
  TomlReader reader(root, toml_path.string());
  DigestSource source;
  source.raw_file = reader.text("raw_file");
  source.raw_hash = reader.text_or("raw_hash", "");
  source.header_lines = reader.integer("header_lines");
  source.header = reader.text_or("header", "");
  source.separator = read_separator(reader);
  source.column_count = reader.integer("column_count");
  source.time_column = reader.integer("time_column");
  source.time_scale = reader.has("time_scale") ? reader.positive_number("time_scale") : 1;
  source.bin_s = reader.positive_number("bin_s");
  source.smoothing_s = reader.has("smoothing_s") ? reader.positive_number("smoothing_s") : 0;
  for (auto& table : reader.tables("columns")) {
    source.columns.push_back(read_column(table));
    if (source.columns.back().number > source.column_count) {
      table.fail("number", fmt::format("the raw file has column_count = {} columns", source.column_count));
    }
  }
  if (source.time_column < 1 || source.time_column > source.column_count) {
    reader.fail("time_column", fmt::format("must lie between 1 and column_count = {}", source.column_count));
  }
  reader.finish();
  return source;
}

std::filesystem::path raw_data_folder() {
  const char* set = std::getenv("SLUICE_RAW_DATA");
  return set && *set ? std::filesystem::path(set) : std::filesystem::path("../shared/data");
}

void make_digest(const DigestSource& source, const std::filesystem::path& raw_path,
                 const std::filesystem::path& out_csv) {
  const auto text = digest_text(source, read_raw(source, raw_path));
  std::ofstream out(out_csv, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    throw std::runtime_error(fmt::format("{}: cannot be written; check the folder and the disk", out_csv.string()));
  }
}

std::filesystem::path make_digest(const std::filesystem::path& data_folder, const std::filesystem::path& raw_root) {
  const auto source = load_digest_source(data_folder / "source.toml");
  auto out = data_folder / "digest.csv";
  make_digest(source, raw_root / source.raw_file, out);
  return out;
}

}  // namespace sluice
