// The read side of a run directory: run.json and probes.csv, our own or another code's.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/series.h"

namespace sluice {

/// One run as found on disk. Of another code's manifest only `case`, `solver` and `l0_m` can be relied on, so that
/// everything else is optional: absent means "missing", never zero.
struct RunRecord {
  std::filesystem::path path;
  nlohmann::json manifest;
  ProbeTable probes;

  std::string case_name;  ///< required in run.json
  std::string solver;     ///< required
  double l0_m = 0;        ///< required
  std::string walls;      ///< empty when not stated
  bool own = false;       ///< written by this project (has `schema`)

  /// Value at a dotted path such as "particles.fluid"; nullopt when missing, null or of another type.
  std::optional<double> number(std::string_view dotted) const;
  std::optional<std::string> text(std::string_view dotted) const;

  std::optional<double> alpha() const { return number("alpha"); }
  /// "running", "finished", "interrupted", "failed"; empty when not stated (external codes).
  std::string status() const { return text("status").value_or(""); }
  /// Short text for legends and table heads, such as "WCSPH extrapolated, l0 = 0.02 m, alpha = 0.01".
  std::string label() const;
  /// What the run noted of itself while it went on (`warnings`); entries that are no text are passed over.
  std::vector<std::string> warnings() const;
  /// Snapshot files under snapshots/, sorted by name.
  std::vector<std::filesystem::path> snapshots() const;
};

/// Reads a run directory; a run that failed before it began has no probes.csv, and then no rows. Throws
/// std::runtime_error naming the file and what is missing or malformed.
RunRecord read_run(const std::filesystem::path& directory);

/// Whether the directory's probes.csv holds rows, or what may have been some.
bool has_rows(const std::filesystem::path& directory);

/// The same from the text of its run.json alone, without probes; messages call it `directory`/run.json.
RunRecord parse_run(std::string_view manifest, const std::filesystem::path& directory);

}  // namespace sluice
