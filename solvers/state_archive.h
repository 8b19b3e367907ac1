// How a solver's state is saved and restored: the solver names what its next steps depend on, once, and an archive goes
// one way or the other.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "solvers/fields.h"

namespace sluice {

class StateArchive {
 public:
  virtual ~StateArchive() = default;
  /// True: values are set from the archive; false: they are written to it.
  virtual bool restoring() const = 0;

  // Names are unique within a solver. Restoring throws std::runtime_error where a name or the length does not fit.
  virtual void value(const std::string& name, double& v) = 0;
  virtual void value(const std::string& name, std::int64_t& v) = 0;
  virtual void values(const std::string& name, std::span<double> v) = 0;
  virtual void values(const std::string& name, std::span<float> v) = 0;
  virtual void values(const std::string& name, std::span<std::int32_t> v) = 0;

  /// Elements first .. first + n - 1 of each component.
  template <class T>
  void values(const std::string& name, VectorField<T>& field, std::size_t first, std::size_t n) {
    values(name + "_x", std::span<T>(field.x).subspan(first, n));
    values(name + "_y", std::span<T>(field.y).subspan(first, n));
    values(name + "_z", std::span<T>(field.z).subspan(first, n));
  }
};

}  // namespace sluice
