// Running gnuplot on a script.
#pragma once

#include <filesystem>
#include <vector>

namespace sluice {

/// Runs `gnuplot` on scripts in `folder`, with that folder as working directory.
/// Throws std::runtime_error when gnuplot is not installed (with the package's name) or fails (with its own message).
void run_gnuplot(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& scripts);

}  // namespace sluice
