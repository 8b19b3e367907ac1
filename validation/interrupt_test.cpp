#include "validation/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace sluice {
namespace {

TEST(Interrupt, IsRememberedUntilAsked) {
  const InterruptGuard guard;
  EXPECT_EQ(InterruptGuard::signal(), 0);
  std::raise(SIGINT);
  EXPECT_EQ(InterruptGuard::signal(), SIGINT);
}

// Whoever ends a whole job tells a run and what waits for it, which tells the run again.
TEST(Interrupt, OneRequestMayComeTwice) {
  const InterruptGuard guard;
  std::raise(SIGTERM);
  std::raise(SIGTERM);
  EXPECT_EQ(InterruptGuard::signal(), SIGTERM);
}

TEST(InterruptDeathTest, AskedAgainTheProcessEndsAtOnce) {
  const auto ask_twice = [] {
    const InterruptGuard guard;
    std::raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::duration<double>(1.1 * same_request_s));
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(ask_twice(), testing::KilledBySignal(SIGTERM), "");
}

TEST(Interrupt, AnotherGuardBeginsAnew) {
  {
    const InterruptGuard guard;
    std::raise(SIGTERM);
  }
  const InterruptGuard guard;
  EXPECT_EQ(InterruptGuard::signal(), 0);
  std::raise(SIGTERM);
  EXPECT_EQ(InterruptGuard::signal(), SIGTERM);
}

}  // namespace
}  // namespace sluice
