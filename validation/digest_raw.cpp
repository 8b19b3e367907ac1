#include "validation/digest_raw.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "validation/file_hash.h"
#include "validation/printable.h"
#include "validation/text_table.h"

namespace sluice {
namespace {

std::vector<std::string> column_labels(const DigestSource& source, std::size_t count) {
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < count; ++k) labels.push_back(fmt::format("column {}", k + 1));
  for (const auto& column : source.columns) {
    labels.at(static_cast<std::size_t>(column.number - 1)) += " (" + column.raw_name + ")";
  }
  return labels;
}

void check_file(const RawFile& file, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw std::runtime_error(
        fmt::format("{}: no such raw file; README.md beside the digest says where it comes from, and the "
                    "environment variable SLUICE_RAW_DATA names the folder of raw data",
                    path.string()));
  }
  if (file.hash.empty()) return;
  const auto hash = file_hash(path);
  if (hash != file.hash) {
    throw std::runtime_error(
        fmt::format("{}: its hash is {}, not {} of the file described; take that file, or describe "
                    "this one and drop raw_hash",
                    path.string(), hash, file.hash));
  }
}

/// Appends the rows of one file.
void append_rows(TextTableReader& reader, const DigestSource& source, const RawFile& file,
                 const std::filesystem::path& path, RawTable& raw) {
  std::string header;
  for (int k = 0; k < file.header_lines; ++k) header = reader.next_header_line();
  if (!file.header.empty() && header != file.header) {
    reader.fail(
        fmt::format("the header is not the one described (\"{}\"); the columns may differ", printable(file.header)));
  }
  RowForm form;
  form.separator = file.separator;
  form.any_order = source.scatter;
  const auto time = static_cast<std::size_t>(source.time_column - 1);
  auto columns = reader.read_rows(column_labels(source, static_cast<std::size_t>(source.column_count)), form, time);
  if (columns[time].size() < 2) throw std::runtime_error(fmt::format("{}: fewer than two rows", path.string()));
  for (std::size_t k = 0; k < source.columns.size(); ++k) {
    std::vector<double> values = columns[static_cast<std::size_t>(source.columns[k].number - 1)];
    rescale(values, 0, source.columns[k].scale, path, source.columns[k].raw_name);
    raw.values[k].insert(raw.values[k].end(), values.begin(), values.end());
  }
  const auto scale_times = source.scatter ? rescale : rescale_times;
  scale_times(columns[time], 0, source.time_scale, path, "time");
  raw.t_s.insert(raw.t_s.end(), columns[time].begin(), columns[time].end());
}

void sort_by_time(RawTable& raw) {
  std::vector<std::size_t> order(raw.t_s.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return raw.t_s[a] < raw.t_s[b]; });
  const auto sorted = [&](const std::vector<double>& from) {
    std::vector<double> to;
    for (const std::size_t i : order) to.push_back(from[i]);
    return to;
  };
  for (auto& values : raw.values) values = sorted(values);
  raw.t_s = sorted(raw.t_s);
}

RawTable empty_table(const DigestSource& source, std::size_t given) {
  if (given != source.files.size())
    throw std::runtime_error(
        fmt::format("{} raw files given, the description names {} (give as many)", given, source.files.size()));
  return {source.files.front().file.string(), {}, std::vector<std::vector<double>>(source.columns.size())};
}

}  // namespace

RawTable read_raw_files(const DigestSource& source, const std::vector<std::filesystem::path>& paths) {
  RawTable raw = empty_table(source, paths.size());
  raw.label = paths.front().string();
  for (std::size_t k = 0; k < paths.size(); ++k) {
    check_file(source.files[k], paths[k]);
    TextTableReader reader(paths[k]);
    append_rows(reader, source, source.files[k], paths[k], raw);
  }
  if (source.scatter) sort_by_time(raw);
  return raw;
}

RawTable parse_raw_files(const DigestSource& source, std::span<const std::string_view> texts) {
  RawTable raw = empty_table(source, texts.size());
  for (std::size_t k = 0; k < texts.size(); ++k) {
    TextTableReader reader(source.files[k].file, texts[k]);
    append_rows(reader, source, source.files[k], source.files[k].file, raw);
  }
  if (source.scatter) sort_by_time(raw);
  return raw;
}

}  // namespace sluice
