// How many floating-point operations a kernel needs a pair: found by giving the solvers' own term functions a number
// type that counts. Additions, multiplications, divisions, roots, magnitudes and choices of the larger or smaller of
// two count one each; conversions, loads and masks count nothing, nor does what a loop does for lanes that it throws
// away.
#pragma once

#include <cmath>
#include <cstdint>

namespace sluice {

/// Stands in for a float or a double. Counts in one variable a thread.
struct CountingReal {
  double value = 0;

  CountingReal() = default;
  CountingReal(double v) : value(v) {}  // NOLINT(google-explicit-constructor): numbers in formulas

  static std::int64_t& operations() {
    thread_local std::int64_t count = 0;
    return count;
  }
  static CountingReal counted(double v) {
    ++operations();
    return {v};
  }
  CountingReal& operator+=(const CountingReal& o) { return *this = counted(value + o.value); }
};

inline CountingReal operator+(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value + b.value);
}
inline CountingReal operator-(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value - b.value);
}
inline CountingReal operator*(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value * b.value);
}
inline CountingReal operator/(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value / b.value);
}
/// A change of sign rides along with the operation after it.
inline CountingReal operator-(const CountingReal& a) {
  return {-a.value};
}
inline CountingReal square_root(const CountingReal& a) {
  return CountingReal::counted(std::sqrt(a.value));
}
inline CountingReal magnitude(const CountingReal& a) {
  return CountingReal::counted(std::abs(a.value));
}
inline CountingReal larger(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value > b.value ? a.value : b.value);
}
inline CountingReal smaller(const CountingReal& a, const CountingReal& b) {
  return CountingReal::counted(a.value < b.value ? a.value : b.value);
}

/// Operations that a call of `evaluate` takes.
template <class Evaluate>
double count_operations(Evaluate&& evaluate) {
  const std::int64_t before = CountingReal::operations();
  evaluate();
  return static_cast<double>(CountingReal::operations() - before);
}

}  // namespace sluice
