// Wall time by phase of a time step.
#pragma once

#include <chrono>
#include <string>

#include "solvers/solver.h"

namespace sluice {

class PhaseClock {
 public:
  /// Runs one phase and adds its time to the account of that name.
  template <class Phase>
  auto time(const char* name, Phase&& phase) {
    const Stop stop{times_[name]};
    return phase();
  }
  const PhaseTimes& times() const { return times_; }

 private:
  struct Stop {
    double& account_s;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    explicit Stop(double& account) : account_s(account) {}
    Stop(const Stop&) = delete;
    Stop& operator=(const Stop&) = delete;
    ~Stop() { account_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  };
  PhaseTimes times_;
};

}  // namespace sluice
