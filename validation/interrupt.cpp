#include "validation/interrupt.h"

#include <array>
#include <ctime>

namespace sluice {
namespace {

volatile std::sig_atomic_t received = 0;

/// When a kind of signal came first; only its handler writes here, which its own kind cannot interrupt.
struct First {
  bool came = false;
  std::timespec at{};
};
std::array<First, 2> firsts;

double seconds_since(const std::timespec& at) {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - at.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - at.tv_nsec);
}

void remember(int number) {
  First& first = firsts[number == SIGINT ? 0 : 1];
  if (!first.came) {
    clock_gettime(CLOCK_MONOTONIC, &first.at);
    first.came = true;
    received = number;
  } else if (seconds_since(first.at) > same_request_s) {
    std::signal(number, SIG_DFL);
    std::raise(number);  // meets the default action when this handler returns
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  received = 0;
  firsts = {};
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
}

int InterruptGuard::signal() {
  return received;
}

}  // namespace sluice
