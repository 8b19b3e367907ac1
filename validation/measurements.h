// What was measured at a case's sensors: one loading, shared by acceptance, reports, `validate` and `compare`.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.h"
#include "validation/measured.h"
#include "validation/metrics.h"

namespace sluice {

/// One digest that a case names.
struct MeasuredFile {
  std::filesystem::path path;  ///< as the case names it
  std::string hash;            ///< of its bytes; empty when the file is not there

  bool present() const { return !hash.empty(); }
};

/// Each digest of the case once, in the order in which its sensors name them.
std::vector<MeasuredFile> measured_files(const Case& c);

/// The measured series of a case by the names of its sensors, on the case's clock (shifts as declared are applied).
class Measurements {
 public:
  /// Reads every digest that is there. What is not is no error: its sensors have no series, and problems() says why.
  /// Throws std::runtime_error for a digest that cannot be read.
  static Measurements load(const Case& c);

  /// nullptr when nothing was measured or the digest is not there.
  const MeasuredSeries* find(std::string_view sensor) const;
  const std::vector<MeasuredFile>& files() const { return files_; }
  /// One sentence for each digest that is not there and each series that a digest lacks, with the remedy.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<MeasuredFile> files_;
  std::vector<std::string> problems_;
  std::map<std::string, MeasuredSeries, std::less<>> series_;
};

/// How a sensor is compared with its measured series: the window, and whether the series is a band.
Window comparison_window(const Case& c, const CaseSensor& sensor);
ComparisonOptions comparison_options(const CaseSensor& sensor);

}  // namespace sluice
