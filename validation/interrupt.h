// SIGINT and SIGTERM as a question that a loop can ask.
#pragma once

#include <csignal>

namespace sluice {

/// While alive, the first SIGINT or SIGTERM is only remembered; a second one of the same kind ends the process at once.
/// At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// The number of the signal that came, or 0.
  static int signal();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace sluice
