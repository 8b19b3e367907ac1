#include "solvers/mps/coarse_row.h"

#include <gtest/gtest.h>

#include <vector>

namespace sluice::mps {
namespace {

TEST(TouchingCells, HaveASlotEachAndOthersHaveNone) {
  const TouchingCells touching(5, 4);
  EXPECT_EQ(touching.offsets().size(), 27U);
  const std::int32_t cell = (2 * 4 + 1) * 5 + 3;
  for (std::size_t slot = 0; slot < touching.offsets().size(); ++slot)
    EXPECT_EQ(touching.slot(cell, cell + touching.offsets()[slot]), slot);
  EXPECT_EQ(touching.slot(cell, cell + 2), TouchingCells::nowhere);
  EXPECT_EQ(touching.slot(cell, cell + 60), TouchingCells::nowhere) << "beyond all of them";
  EXPECT_EQ(touching.slot(cell, no_cell), TouchingCells::nowhere);
}

TEST(TouchingCells, OfANarrowGridAreToldApart) {
  const TouchingCells touching(1, 2);
  for (const std::int32_t to : {0, 1, 2, 3}) EXPECT_NE(touching.slot(1, to), TouchingCells::nowhere) << to;
  EXPECT_NE(touching.slot(1, 0), touching.slot(1, 2));
}

TEST(CoarseRow, SumsTheEntriesThatLeadToEachCell) {
  const TouchingCells touching(3, 1);
  // Unknowns 0 .. 4 in cells 0, 1, 1, 2 and in none; the row of unknown 1.
  const std::vector<std::int32_t> cell_of{0, 1, 1, 2, no_cell};
  const std::vector<std::int32_t> number_of_cell{7, 8, -1};
  const std::vector<Span> rows{{}, {0, 4}};
  const std::vector<std::int32_t> columns{0, 2, 0, 4};
  const std::vector<float> weights{0.5F, 2, 0.25F, 9};
  CoarseRow<float> row;
  row.start(1);
  row.add(touching, {rows, columns.data(), weights.data()}, cell_of, 1);
  row.finish(touching, number_of_cell, 2);
  EXPECT_EQ(row.within(), 4) << "the entry to unknown 2, times the factor";
  ASSERT_EQ(row.size(), 1U) << "nothing leads to cell 2";
  EXPECT_EQ(row.columns()[0], 7);
  EXPECT_EQ(row.values()[0], 1.5F);
}

}  // namespace
}  // namespace sluice::mps
