// What stands in other people's files, made fit to stand in a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sluice {

/// Control characters come out as \x1b, so that no file can play with a terminal or break a line; what comes out
/// longer than `most` bytes is cut at a whole character and ends in "...".
std::string printable(std::string_view text, std::size_t most = 200);

/// One word of a shell's command line, whatever stands in it.
std::string shell_quoted(std::string_view text);

/// Letters of ASCII in capitals: "wcsph" is an abbreviation.
std::string in_capitals(std::string_view text);

}  // namespace sluice
