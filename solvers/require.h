// How solvers refuse a parameter.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace sluice {

/// Throws std::invalid_argument, with name, value and the range in words, unless the value is good.
inline void require(bool good, const char* name, double value, const char* range) {
  if (!good) throw std::invalid_argument(fmt::format("{} = {} is out of its range: it must be {}", name, value, range));
}

}  // namespace sluice
