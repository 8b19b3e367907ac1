#include "validation/available_memory.h"

#include <gtest/gtest.h>

#include <fstream>

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// A tree of control groups as the kernel shows it.
class GroupMemory : public testing::Test {
 protected:
  GroupMemory() { fs::remove_all(root_); }
  ~GroupMemory() override { fs::remove_all(root_); }

  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  void group_2(const fs::path& group, const std::string& limit, const std::string& usage, const std::string& cache) {
    write(group / "memory.max", limit + "\n");
    write(group / "memory.current", usage + "\n");
    write(group / "memory.stat", "anon 100\nfile 9999\ninactive_file " + cache + "\nactive_file 50\n");
  }

  fs::path root_ = fs::temp_directory_path() /
                   (std::string("sluice-groups-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GroupMemory, WithoutALimitThereIsNothingToTell) {
  EXPECT_FALSE(group_available_bytes(root_, "0::/\n"));
  group_2("user.slice", "max", "700", "100");
  EXPECT_FALSE(group_available_bytes(root_, "0::/user.slice\n"));
  EXPECT_FALSE(group_available_bytes(root_, "no such form\n"));
}

TEST_F(GroupMemory, ThePageCacheIsFree) {
  group_2("", "1000", "900", "550");
  EXPECT_EQ(group_available_bytes(root_, "0::/\n"), 1000 - (900 - 600));
}

TEST_F(GroupMemory, TheNarrowestOfTheGroupsAroundCounts) {
  group_2("job", "1000", "400", "0");
  group_2("job/step", "500", "200", "0");
  group_2("job/step/task", "max", "100", "0");
  EXPECT_EQ(group_available_bytes(root_, "0::/job/step/task\n"), 500 - 150);
  EXPECT_EQ(group_available_bytes(root_, "0::/job\n"), 1000 - 350);
  EXPECT_EQ(group_available_bytes(root_, "0::/job/other\n"), 1000 - 350) << "a path that is not there";
}

TEST_F(GroupMemory, VersionOneCountsWithTheGroupsBelow) {
  write("memory/job/memory.limit_in_bytes", "1000\n");
  write("memory/job/memory.usage_in_bytes", "900\n");
  write("memory/job/memory.stat", "inactive_file 1\nactive_file 1\ntotal_inactive_file 300\ntotal_active_file 200\n");
  EXPECT_EQ(group_available_bytes(root_, "9:cpu:/job\n4:memory:/job\n0::/\n"), 1000 - (900 - 500));
  EXPECT_EQ(group_available_bytes(root_, "4:hugetlb,memory:/job\n"), 1000 - (900 - 500));
  EXPECT_FALSE(group_available_bytes(root_, "9:cpu:/job\n"));
}

TEST(AvailableMemory, IsToldOnThisSystem) {
  const auto bytes = available_memory_bytes();
  if (!fs::exists("/proc/meminfo")) GTEST_SKIP() << "no /proc/meminfo on this system";
  ASSERT_TRUE(bytes);
  EXPECT_GT(*bytes, 1 << 20);
}

}  // namespace
}  // namespace sluice
