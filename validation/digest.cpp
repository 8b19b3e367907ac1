#include "validation/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>
#include <stdexcept>

#include "validation/curve.h"
#include "validation/digest_raw.h"
#include "validation/printable.h"

namespace sluice {

namespace {

/// A bin at either end that the samples cover by less is left out: its mean would be that of another stretch of time.
constexpr double least_cover_of_recording = 0.9;
constexpr double least_cover_of_scatter = 0.5;

/// More would be no digest; bins are told apart by their centres, written with 12 digits.
constexpr double most_bins = 1e6;
constexpr double largest_bin_number = 1e9;

/// Bins k = first..last - 1 are [k bin_s, (k + 1) bin_s].
struct BinRange {
  long first = 0;
  long last = 0;
};

Window bin_edges(long k, double bin_s) {
  return {static_cast<double>(k) * bin_s, static_cast<double>(k + 1) * bin_s};
}

void check_bin_width(const RawTable& raw, double bin_s) {
  const double first = raw.t_s.front() / bin_s;
  const double last = raw.t_s.back() / bin_s;
  if (last - first < most_bins && std::abs(first) < largest_bin_number && std::abs(last) < largest_bin_number) return;
  throw std::runtime_error(
      fmt::format("{}: times from {} to {} s make too many bins of {} s; are bin_s and the scale of time right?",
                  raw.label, raw.t_s.front(), raw.t_s.back(), bin_s));
}

BinRange covered_bins(const std::vector<double>& t_s, double bin_s, double least_cover) {
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

/// What the digest holds of a column in one bin.
struct BinValues {
  double mean = 0;
  double low = 0;
  double high = 0;
  double smoothed_high = 0;
  std::size_t points = 0;
};

/// Values with times in the bin, its end excluded; times may repeat. A time that is written as an edge, such as 1.275
/// s, begins a bin whatever the rounding of 51 times 0.025.
std::span<const double> samples_in(const Curve& curve, Window edges) {
  constexpr double rounding_s = 1e-9;
  const auto first = first_at_or_after(curve, edges.begin_s - rounding_s);
  return curve.value.subspan(first, first_at_or_after(curve, edges.end_s - rounding_s) - first);
}

std::span<const double> some_samples_in(const Curve& curve, Window edges, const std::string& name) {
  const auto samples = samples_in(curve, edges);
  if (samples.empty())
    throw std::runtime_error(
        fmt::format("{}: no sample between {} and {} s; choose a wider bin_s", name, edges.begin_s, edges.end_s));
  return samples;
}

std::vector<BinValues> recording_bins(const Series& samples, BinRange range, const DigestSource& source,
                                      const std::string& name) {
  const CumulativeIntegral integral(samples);
  const Series smoothed = source.smoothing_s > 0 ? running_mean(samples, source.smoothing_s) : Series{};
  std::vector<BinValues> bins;
  for (long k = range.first; k < range.last; ++k) {
    const Window edges = bin_edges(k, source.bin_s);
    const Window covered = clipped(samples, edges);
    const auto inside = some_samples_in(samples, edges, name);
    BinValues bin;
    bin.points = inside.size();
    bin.mean = integral.between(covered.begin_s, covered.end_s) / (covered.end_s - covered.begin_s);
    bin.low = *std::min_element(inside.begin(), inside.end());
    bin.high = *std::max_element(inside.begin(), inside.end());
    if (source.smoothing_s > 0) {
      const auto means = some_samples_in(smoothed, edges, name);
      bin.smoothed_high = *std::max_element(means.begin(), means.end());
    }
    bins.push_back(bin);
  }
  return bins;
}

/// One value a time: the mean of the points at it.
Series through_points(const Series& points) {
  Series curve{points.name, points.unit, {}, {}};
  for (std::size_t i = 0; i < points.t_s.size();) {
    double sum = 0;
    std::size_t count = 0;
    for (; i + count < points.t_s.size() && points.t_s[i + count] == points.t_s[i]; ++count)
      sum += points.value[i + count];
    curve.t_s.push_back(points.t_s[i]);
    curve.value.push_back(sum / static_cast<double>(count));
    i += count;
  }
  return curve;
}

/// Bins without points get the straight line between the nearest that have some.
void bridge_gaps(std::vector<BinValues>& bins) {
  std::size_t left = 0;
  for (std::size_t right = 1; right < bins.size(); ++right) {
    if (bins[right].points == 0) continue;
    for (std::size_t k = left + 1; k < right; ++k) {
      const double share = static_cast<double>(k - left) / static_cast<double>(right - left);
      for (double BinValues::*value : {&BinValues::mean, &BinValues::low, &BinValues::high, &BinValues::smoothed_high})
        bins[k].*value = bins[left].*value + share * (bins[right].*value - bins[left].*value);
    }
    left = right;
  }
}

std::vector<BinValues> scatter_bins(const Series& points, BinRange& range, const DigestSource& source) {
  const Series curve = through_points(points);
  const Series smoothed = source.smoothing_s > 0 ? running_mean(curve, source.smoothing_s) : curve;
  while (range.first < range.last && samples_in(points, bin_edges(range.first, source.bin_s)).empty()) ++range.first;
  std::vector<BinValues> bins;
  for (long k = range.first; k < range.last; ++k) {
    const Window edges = bin_edges(k, source.bin_s);
    const auto inside = samples_in(points, edges);
    BinValues bin;
    bin.points = inside.size();
    if (bin.points > 0) {
      const auto means = samples_in(smoothed, edges);
      bin.mean = std::accumulate(inside.begin(), inside.end(), 0.0) / static_cast<double>(bin.points);
      bin.low = *std::min_element(inside.begin(), inside.end());
      bin.high = *std::max_element(inside.begin(), inside.end());
      bin.smoothed_high = *std::max_element(means.begin(), means.end());
    }
    bins.push_back(bin);
  }
  while (!bins.empty() && bins.back().points == 0) bins.pop_back();
  bridge_gaps(bins);
  range.last = range.first + static_cast<long>(bins.size());
  return bins;
}

std::string column_header(const DigestColumn& column, const DigestSource& source) {
  auto text = fmt::format(",{0}_mean_{1},{0}_min_{1},{0}_max_{1}", column.name, column.unit);
  if (source.smoothing_s > 0)
    text += fmt::format(",{}_max{:.6g}ms_{}", column.name, 1e3 * source.smoothing_s, column.unit);
  return source.scatter ? text + fmt::format(",{}_points_1", column.name) : text;
}

void append_bin(std::string& out, const BinValues& bin, const DigestColumn& column, const DigestSource& source) {
  append_number(out, bin.mean, column.mean_decimals);
  append_number(out, bin.low, column.extreme_decimals);
  append_number(out, bin.high, column.extreme_decimals);
  if (source.smoothing_s > 0) append_number(out, bin.smoothed_high, column.extreme_decimals);
  if (source.scatter) out += fmt::format(",{}", bin.points);
}

void check_digest(const std::vector<BinValues>& bins, const std::string& label, double bin_s) {
  if (bins.size() < 2)
    throw std::runtime_error(
        fmt::format("{}: fewer than two bins of {} s are covered by samples; choose a narrower bin_s", label, bin_s));
  for (const BinValues& bin : bins)
    if (!std::isfinite(bin.mean) || !std::isfinite(bin.smoothed_high))
      throw std::runtime_error(fmt::format("{}: its values are too large for means; are unit and scale right?", label));
}

std::string digest_text(const DigestSource& source, const RawTable& raw) {
  check_bin_width(raw, source.bin_s);
  BinRange range =
      covered_bins(raw.t_s, source.bin_s, source.scatter ? least_cover_of_scatter : least_cover_of_recording);
  std::string text = "t_s";
  std::vector<std::vector<BinValues>> columns;
  for (std::size_t k = 0; k < source.columns.size(); ++k) {
    const DigestColumn& column = source.columns[k];
    const Series series{column.name, column.unit, raw.t_s, raw.values[k]};
    const std::string label = fmt::format("{}: {}", raw.label, printable(column.raw_name));
    columns.push_back(source.scatter ? scatter_bins(series, range, source)
                                     : recording_bins(series, range, source, label));
    check_digest(columns.back(), label, source.bin_s);
    text += column_header(column, source);
  }
  text += '\n';
  for (long bin = range.first; bin < range.last; ++bin) {
    fmt::format_to(std::back_inserter(text), "{:.12g}", (static_cast<double>(bin) + 0.5) * source.bin_s);
    for (std::size_t k = 0; k < columns.size(); ++k)
      append_bin(text, columns[k][static_cast<std::size_t>(bin - range.first)], source.columns[k], source);
    text += '\n';
  }
  return text;
}

}  // namespace

void make_digest(const DigestSource& source, const std::vector<std::filesystem::path>& raw,
                 const std::filesystem::path& out_csv) {
  const auto text = digest_text(source, read_raw_files(source, raw));
  std::ofstream out(out_csv, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    throw std::runtime_error(fmt::format("{}: cannot be written; check the folder and the disk", out_csv.string()));
  }
}

std::string digest_of(const DigestSource& source, std::span<const std::string_view> raw_texts) {
  return digest_text(source, parse_raw_files(source, raw_texts));
}

std::vector<std::filesystem::path> make_digests(const std::filesystem::path& data_folder,
                                                const std::filesystem::path& raw_root) {
  std::vector<std::filesystem::path> made;
  for (const DigestPlan& plan : digest_plans(data_folder)) {
    const auto source = load_digest_source(plan.description);
    make_digest(source, raw_paths(source, raw_root), plan.digest);
    made.push_back(plan.digest);
  }
  return made;
}

}  // namespace sluice
