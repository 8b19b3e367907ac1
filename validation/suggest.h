// "Did you mean": the candidate closest to a mistyped name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

/// The candidate that differs from `name` by the fewest insertions, deletions and replacements: at most a third of the
/// name's length, or two (one in a name of up to three letters).
std::optional<std::string> closest(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean `alpha`?)", or " (known: a, b, c)" when nothing is close.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace sluice
