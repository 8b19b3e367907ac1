// Cells of a report's tables by what stands beside and above them, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "reports/tables.h"

namespace sluice::test_files {

inline std::size_t column_of(const Table& table, const std::string& csv_name) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].csv_name == csv_name) return i;
  ADD_FAILURE() << "no column " << csv_name << " in " << table.name;
  return 0;
}

/// The first row whose first cell begins with `start`, and whose second begins with `second`.
inline const TableRow& row_of(const Table& table, const std::string& start, const std::string& second = "") {
  for (const TableRow& row : table.rows)
    if (!row.is_group() && row.cells[0].text.starts_with(start) && row.cells[1].text.starts_with(second)) return row;
  ADD_FAILURE() << "no row " << start << ' ' << second << " in " << table.name;
  return table.rows.front();
}

inline const TableCell& cell(const Table& table, const std::string& start, const std::string& csv_name,
                             const std::string& second = "") {
  return row_of(table, start, second).cells[column_of(table, csv_name)];
}

}  // namespace sluice::test_files
