// Errors that name the file they are about.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace sluice {

/// Throws std::runtime_error with "FILE: WHAT".
[[noreturn]] inline void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

}  // namespace sluice
