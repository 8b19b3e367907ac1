#include "validation/manifest.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

TEST(BuildInfo, OnlyACommitByItselfNamesOneBuild) {
  EXPECT_TRUE(names_one_build("0123456789ab"));
  EXPECT_FALSE(names_one_build("0123456789ab-dirty"));
  EXPECT_FALSE(names_one_build("unknown")) << "as in a tree that git does not read";
  EXPECT_FALSE(names_one_build(""));
}

}  // namespace
}  // namespace sluice
