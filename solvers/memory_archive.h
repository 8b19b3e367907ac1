// A solver's state in memory, for tests.
#pragma once

#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "solvers/state_archive.h"

namespace sluice {

class MemoryArchive : public StateArchive {
 public:
  bool restoring() const override { return restoring_; }
  /// From now on values are restored.
  void rewind() { restoring_ = true; }

  void value(const std::string& name, double& v) override { move(name, &v, sizeof v); }
  void value(const std::string& name, std::int64_t& v) override { move(name, &v, sizeof v); }
  void values(const std::string& name, std::span<double> v) override { move(name, v.data(), v.size_bytes()); }
  void values(const std::string& name, std::span<float> v) override { move(name, v.data(), v.size_bytes()); }
  void values(const std::string& name, std::span<std::int32_t> v) override { move(name, v.data(), v.size_bytes()); }

 private:
  void move(const std::string& name, void* at, std::size_t bytes) {
    if (!restoring_) {
      if (!kept_.emplace(name, std::vector<char>(static_cast<char*>(at), static_cast<char*>(at) + bytes)).second)
        throw std::logic_error(name + " was named twice");
      return;
    }
    const std::vector<char>& kept = kept_.at(name);
    if (kept.size() != bytes) throw std::runtime_error(name + " has another length");
    if (bytes > 0) std::memcpy(at, kept.data(), bytes);
  }

  bool restoring_ = false;
  std::map<std::string, std::vector<char>> kept_;
};

}  // namespace sluice
