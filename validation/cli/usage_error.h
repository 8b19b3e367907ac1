#pragma once

#include <stdexcept>

namespace sluice::cli {

/// A command line that cannot be carried out as it stands: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sluice::cli
