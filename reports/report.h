// The comparison report: run directories in, tables, figures and one HTML page out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

struct ReportData;

struct ReportOptions {
  std::string title;      ///< empty: made from the case's title
  bool figures = true;    ///< false: tables and text only, gnuplot is not needed
  bool snapshots = true;  ///< false: leave out the particle pictures
};

/// Writes report.md, index.html, tables/*.{csv,tex} and figures/*.{gp,dat,svg,png} into `out` (made when missing).
/// Reads run directories only (run.json, probes.csv, snapshots), the case file that they name, and the case's measured
/// data. All runs must be of one case. What a run does not tell is printed as "missing".
/// Throws std::runtime_error naming the file and the remedy: no run given, no such directory, runs of several cases,
/// gnuplot missing.
void write_report(const std::vector<std::filesystem::path>& run_directories, const std::filesystem::path& out,
                  const ReportOptions& options = {});

/// The same of what analyse() has read.
void write_analysed(const ReportData& data, const std::filesystem::path& out, const ReportOptions& options = {});

}  // namespace sluice
