// Running another program and waiting for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::bench {

/// Runs a program with its arguments; what it prints goes to a file. Returns its exit status, or 128 and the number of
/// the signal that ended it. Throws std::runtime_error when it cannot be started.
int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// The last line of a file that is not empty, or "it printed nothing".
std::string last_line(const std::filesystem::path& file);

}  // namespace sluice::bench
