// How the columns of another code's file are named.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/foreign.h"
#include "validation/text_table.h"

namespace sluice {

/// Reads the header: names of the columns as its last line has them, without quotes, or numbers from 1 on where there
/// is none. A comment's first name is that of the first column; where it names fewer than there are (as OpenFOAM's
/// probes do: "# Time"), the others have numbers.
std::vector<std::string> column_names(TextTableReader& reader, const ForeignFile& file);

/// The index, from 0 on, of a column given by its name or its number. Throws `file:line: message` where there is none.
std::size_t index_of(const TextTableReader& reader, const std::vector<std::string>& names, const std::string& column);

}  // namespace sluice
