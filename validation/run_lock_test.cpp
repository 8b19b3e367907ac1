#include "validation/run_lock.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <stdexcept>

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class RunLockTest : public testing::Test {
 protected:
  RunLockTest() { fs::create_directories(directory); }
  ~RunLockTest() override { fs::remove_all(directory); }

  std::string refusal() const {
    try {
      const RunLock second(directory);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }
  fs::path directory = fs::temp_directory_path() / "sluice-run-lock-test";
};

TEST_F(RunLockTest, IsHeldByOneAtATime) {
  std::optional<RunLock> first(std::in_place, directory);
  EXPECT_TRUE(first->held());
  EXPECT_THAT(refusal(), AllOf(HasSubstr(directory.string()), HasSubstr(fmt::format("process {} on ", getpid())),
                               HasSubstr("computes here at this moment"), HasSubstr("wait until it has ended")));
  first.reset();
  EXPECT_EQ(refusal(), "accepted") << "the file that is left behind locks nothing";
}

TEST_F(RunLockTest, IsStillHeldWhenItHasMoved) {
  RunLock first(directory);
  {
    const RunLock moved(std::move(first));
    EXPECT_THAT(refusal(), HasSubstr("computes here"));
  }
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(RunLockTest, ADirectoryThatTakesNoFileIsToldSo) {
  fs::create_directories(directory / lock_file);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(lock_file), HasSubstr("cannot be opened: Is a directory")));
}

TEST_F(RunLockTest, WhatAForeignFileHoldsIsShownHarmlessly) {
  const RunLock first(directory);
  std::ofstream(directory / lock_file) << "\x1b[31mred\nmore";
  EXPECT_THAT(refusal(), HasSubstr("\\x1b[31mred computes here"));
}

}  // namespace
}  // namespace sluice
