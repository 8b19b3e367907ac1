#include "validation/printable.h"

#include <fmt/format.h>

#include <cctype>
#include <iterator>

namespace sluice {
namespace {

bool is_control(unsigned char byte) {
  return byte < 0x20 || byte == 0x7f;
}

/// Bytes behind the first of a character in UTF-8.
bool is_continuation(unsigned char byte) {
  return (byte & 0xc0) == 0x80;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t whole = 0;  // bytes of `out` up to a character's end that leave it at `most`
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (out.size() <= most && !is_continuation(byte)) whole = out.size();
    if (is_control(byte)) {
      fmt::format_to(std::back_inserter(out), "\\x{:02x}", byte);
    } else {
      out += character;
    }
    if (out.size() > most) return out.substr(0, whole) + "...";
  }
  return out;
}

std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string in_capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

}  // namespace sluice
