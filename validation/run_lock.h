// One program at a time in a run directory.
#pragma once

#include <filesystem>
#include <stdexcept>

namespace sluice {

/// A run is refused for what will pass: another program computes there, memory is short. What it has is good.
struct NotNow : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The file in a run directory that is locked while a program computes there; it names that program, and stays behind.
inline constexpr const char* lock_file = ".lock";

/// Held while alive, and let go by the system when the process dies, however it dies.
class RunLock {
 public:
  /// Throws NotNow naming the directory, who computes there, and the remedy; std::runtime_error when the lock's file
  /// cannot be opened.
  explicit RunLock(const std::filesystem::path& directory);
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// False where the file system knows no locks: then nothing keeps a second program out.
  bool held() const { return held_; }

 private:
  int descriptor_;
  bool held_ = false;
};

}  // namespace sluice
