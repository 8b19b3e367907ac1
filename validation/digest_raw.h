// Inner part of make_digest(): the raw files, read as their description says.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/digest.h"

namespace sluice {

struct RawTable {
  std::string label;  ///< what messages call it: its first file
  std::vector<double> t_s;
  std::vector<std::vector<double>> values;  ///< one for each column of the description, scaled
};

/// Throws std::runtime_error naming file and line.
RawTable read_raw_files(const DigestSource& source, const std::vector<std::filesystem::path>& paths);
/// The same from the files' texts.
RawTable parse_raw_files(const DigestSource& source, std::span<const std::string_view> texts);

}  // namespace sluice
