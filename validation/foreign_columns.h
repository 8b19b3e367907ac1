// How the columns of another code's file are named.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/foreign.h"
#include "validation/text_table.h"

namespace sluice {

/// The columns of a file, each by the name that its map may give it.
struct ColumnNames {
  std::vector<std::string> names;  ///< of the header, or numbers from 1 on
  std::size_t left_out = 0;        ///< names of a header that has another number of them than the rows have fields
};

/// Reads the header: names of the columns as its last line has them, without quotes, or numbers from 1 on where there
/// is none. Where the first row has another number of fields (a title, names with blanks between blanks) no name can be
/// told to be that of a column, and they have numbers. Only a comment's first name is that of the first column where it
/// names fewer than there are (as OpenFOAM's probes do: "# Time"). A separator too many at the end of the header or of
/// the row is no column.
ColumnNames column_names(TextTableReader& reader, const ForeignFile& file);

/// The index, from 0 on, of a column given by its name or its number. Throws `file:line: message` where there is none.
std::size_t index_of(const TextTableReader& reader, const ColumnNames& columns, const std::string& column);

}  // namespace sluice
