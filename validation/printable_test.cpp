#include "validation/printable.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  EXPECT_EQ(printable("P1 [Pa], Höhe"), "P1 [Pa], Höhe");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ShowsControlCharacters) {
  EXPECT_EQ(printable("a\x1b[2J\nb\x7f"), "a\\x1b[2J\\x0ab\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Printable, CutsWhatIsLongAtAWholeCharacter) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("ä", 1), "...");
  EXPECT_EQ(printable("aäb", 2), "a...");
  EXPECT_EQ(printable("a\n\nb", 6), "a\\x0a...");
}

}  // namespace
}  // namespace sluice
