#include "validation/measured.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "validation/file_hash.h"
#include "validation/printable.h"
#include "validation/series.h"

namespace sluice {

namespace {

constexpr std::string_view mean_mark = "_mean";

double bin_width_s(const ProbeTable& table) {
  const auto& t = table.times_s();
  const auto file = table.path().string();
  if (t.size() < 2) throw std::runtime_error(fmt::format("{}: {} bins; a digest needs two or more", file, t.size()));
  const double width = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (std::abs(t[i] - t[i - 1] - width) > 1e-3 * width) {
      throw std::runtime_error(
          fmt::format("{}:{}: t_s: the bin at {} s is not {:.6g} s after the one before; make the "
                      "digest anew with \"sluice data digest\"",
                      file, i + 2, t[i], width));
    }
  }
  return width;
}

std::vector<double> digest_column(const ProbeTable& table, const std::string& name) {
  if (!table.has(name)) {
    throw std::runtime_error(
        fmt::format("{}:1: column {} is missing; a digest has <name>_mean_<unit>, <name>_min_<unit> and "
                    "<name>_max_<unit> for each series",
                    table.path().string(), printable(name)));
  }
  return table.values(name);
}

/// Reads `<name>_max<k>ms_<unit>` where there is such a column.
void add_smoothed_maximum(const ProbeTable& table, MeasuredSeries& series) {
  const std::string begin = series.name + "_max";
  const std::string end = "ms_" + series.unit;
  for (const auto& header : table.names()) {
    if (!header.starts_with(begin) || !header.ends_with(end) || header.size() <= begin.size() + end.size()) continue;
    const auto digits = header.substr(begin.size(), header.size() - begin.size() - end.size());
    double width_ms = 0;
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), width_ms);
    if (error != std::errc{} || last != digits.data() + digits.size() || !(width_ms > 0) || !std::isfinite(width_ms))
      continue;
    series.smoothing_s = 1e-3 * width_ms;
    series.smoothed_maximum = table.values(header);
  }
}

void check_bins(const MeasuredSeries& series, const std::string& file) {
  for (std::size_t i = 0; i < series.t_s.size(); ++i) {
    if (series.minimum[i] > series.maximum[i]) {
      throw std::runtime_error(
          fmt::format("{}:{}: {}: minimum {} over maximum {}; make the digest anew with "
                      "\"sluice data digest\"",
                      file, i + 2, printable(series.name), series.minimum[i], series.maximum[i]));
    }
  }
}

}  // namespace

MeasuredData MeasuredData::load(const std::filesystem::path& path) {
  return {read_probes(path), file_hash(path)};
}

MeasuredData MeasuredData::parse(std::string_view text, const std::filesystem::path& path) {
  return {parse_probes(text, path), text_hash(text)};
}

MeasuredData::MeasuredData(const ProbeTable& table, std::string hash) : path_(table.path()), hash_(std::move(hash)) {
  const double width = bin_width_s(table);
  for (const auto& header : table.names()) {
    const auto [marked_name, unit] = split_column_name(header);
    if (!marked_name.ends_with(mean_mark)) continue;
    const std::string name = marked_name.substr(0, marked_name.size() - mean_mark.size());
    MeasuredSeries series{name,
                          unit,
                          table.times_s(),
                          table.values(header),
                          digest_column(table, fmt::format("{}_min_{}", name, unit)),
                          digest_column(table, fmt::format("{}_max_{}", name, unit)),
                          width,
                          {},
                          0,
                          {}};
    add_smoothed_maximum(table, series);
    if (const std::string count = name + "_points_1"; table.has(count)) series.points = table.values(count);
    check_bins(series, path_.string());
    names_.push_back(name);
    series_.emplace(name, std::move(series));
  }
  if (names_.empty()) {
    throw std::runtime_error(fmt::format("{}:1: no column <name>_mean_<unit>; this is not a digest", path_.string()));
  }
}

bool MeasuredData::has(std::string_view name) const {
  return series_.contains(name);
}

const MeasuredSeries& MeasuredData::series(std::string_view name) const {
  const auto at = series_.find(name);
  if (at == series_.end()) {
    throw std::out_of_range(
        fmt::format("{}: no series {}; there are: {}", path_.string(), name, fmt::join(names_, ", ")));
  }
  return at->second;
}

}  // namespace sluice
