// SIGINT and SIGTERM as a question that a loop can ask.
#pragma once

#include <csignal>

namespace sluice {

/// Signals of one kind that come within this time are one request: a service manager tells every process of a job, and
/// `timeout`, told too, tells its child again.
constexpr double same_request_s = 1;

/// While alive, the first SIGINT or SIGTERM is only remembered; one of the same kind that comes more than
/// same_request_s after it ends the process at once. At most one at a time.
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
