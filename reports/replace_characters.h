// UTF-8 text, character by character.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace sluice {

/// The bytes of the UTF-8 character that starts at `at`.
inline std::string_view character(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  return text.substr(at, length);
}

/// A character, and what takes its place.
using Replacement = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string replace_characters(std::string_view text, const std::array<Replacement, N>& replacements) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view c = character(text, i);
    std::string_view with = c;
    for (const auto& [from, to] : replacements)
      if (from == c) with = to;
    out += with;
    i += c.size();
  }
  return out;
}

}  // namespace sluice
