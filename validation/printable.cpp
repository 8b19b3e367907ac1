#include "validation/printable.h"

#include <fmt/format.h>

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
  const bool cut = text.size() > most;
  if (cut) {
    while (most > 0 && is_continuation(static_cast<unsigned char>(text[most]))) --most;
    text = text.substr(0, most);
  }
  std::string out;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (is_control(byte)) {
      fmt::format_to(std::back_inserter(out), "\\x{:02x}", byte);
    } else {
      out += character;
    }
  }
  return cut ? out + "..." : out;
}

}  // namespace sluice
