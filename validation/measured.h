// Measured series as the project keeps them: digests in bins of equal width, made by `sluice data digest`.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "validation/series.h"

namespace sluice {

/// One measured quantity in bins that touch each other. `mean` is the time-mean over the bin (so that mean * bin_s
/// summed is the impulse), `minimum` and `maximum` are those of the samples in the bin.
struct MeasuredSeries {
  std::string name;         ///< such as "P1"
  std::string unit;         ///< such as "Pa"
  std::vector<double> t_s;  ///< bin centres
  std::vector<double> mean;
  std::vector<double> minimum;
  std::vector<double> maximum;
  double bin_s = 0;
  /// Largest value in the bin of the running mean (over smoothing_s) of the unbinned samples; empty when the digest has
  /// none.
  std::vector<double> smoothed_maximum;
  double smoothing_s = 0;
  /// How many points of a scatter the bin holds; where none, the bin's values are the straight line between its
  /// neighbours'. Empty for a recording, whose bins all hold samples.
  std::vector<double> points{};

  bool has_points(std::size_t bin) const { return points.empty() || points[bin] > 0; }
};

/// All series of one digest: `t_s,P1_mean_Pa,P1_min_Pa,P1_max_Pa,P1_max10ms_Pa,P1_points_1,...`, t_s the bin centres.
/// The last two kinds of columns, of which the first gives smoothing_s in milliseconds in its name, may be absent.
class MeasuredData {
 public:
  MeasuredData() = default;
  /// Throws std::runtime_error naming file and line or column and the remedy.
  static MeasuredData load(const std::filesystem::path& path);
  /// The same from text; `path` is what messages call it.
  static MeasuredData parse(std::string_view text, const std::filesystem::path& path);

  bool has(std::string_view name) const;
  /// Throws std::out_of_range naming the file and the series that it has.
  const MeasuredSeries& series(std::string_view name) const;
  /// In the file's order.
  const std::vector<std::string>& names() const { return names_; }
  const std::filesystem::path& path() const { return path_; }
  /// Of the digest file's bytes, such as "fnv1a64:0123456789abcdef"; for the manifest.
  const std::string& hash() const { return hash_; }

 private:
  MeasuredData(const ProbeTable& table, std::string hash);

  std::filesystem::path path_;
  std::string hash_;
  std::vector<std::string> names_;
  std::map<std::string, MeasuredSeries, std::less<>> series_;
};

}  // namespace sluice
