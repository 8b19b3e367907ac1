// What every reader of files promises, for the fuzzers that hold it to that: either it reads a text, or it throws a
// std::runtime_error that begins with the file's name, is a line of printable text, and is short enough to be read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "validation/series.h"

namespace sluice::fuzz {

inline constexpr std::size_t longest_message = 2000;

inline bool is_clear(std::string_view message, std::string_view file) {
  const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; };
  return message.starts_with(file) && message.size() <= longest_message &&
         std::none_of(message.begin(), message.end(), is_control);
}

/// Runs `read`. Whatever else it throws ends the process, and so is found.
template <class Read>
void expect_clear_error(std::string_view file, const Read& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    if (is_clear(error.what(), file)) return;
    std::fprintf(stderr, "unclear error: %s\n", error.what());
    std::abort();
  }
}

/// What every table of series promises.
inline void expect_clean(const ProbeTable& table) {
  const auto& t_s = table.times_s();
  const auto finite = [](double value) { return std::isfinite(value); };
  bool clean = std::all_of(t_s.begin(), t_s.end(), finite) &&
               std::adjacent_find(t_s.begin(), t_s.end(), std::greater_equal<>()) == t_s.end();
  for (const std::string& name : table.names()) {
    const auto& values = table.values(name);
    clean = clean && values.size() == t_s.size() && std::all_of(values.begin(), values.end(), finite);
  }
  if (!clean) std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The texts between lines that hold "====" alone: several files in one input.
inline std::vector<std::string_view> split_files(std::string_view text) {
  constexpr std::string_view mark = "\n====\n";
  std::vector<std::string_view> files;
  for (auto at = text.find(mark); at != std::string_view::npos; at = text.find(mark)) {
    files.push_back(text.substr(0, at + 1));
    text.remove_prefix(at + mark.size());
  }
  files.push_back(text);
  return files;
}

}  // namespace sluice::fuzz
