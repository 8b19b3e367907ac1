// What tells the inputs of two case files apart, where their bytes tell more than that.
#pragma once

#include <string>

// Forward declaration would have to repeat the library's inline namespace.
#include <toml++/toml.h>

namespace sluice {

/// A hash, as text_hash() gives, of all that is computed from in a case file's table. Order, spacing and comments do
/// not enter, nor do the keys that only texts, the judgement and reports read; any other key does.
std::string computed_hash(const toml::table& the_case);

}  // namespace sluice
