// The files that a run directory starts with: nothing of an older run, and a log.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "validation/run_lock.h"

namespace sluice {

/// Makes the directory and locks it. One in which another program computes is refused in any case. One that holds a run
/// already is refused unless that run failed or was interrupted and left neither rows of sensors nor a checkpoint, or
/// `force` is given; its files (and no others) are then removed. Throws std::runtime_error naming the directory and the
/// remedy.
[[nodiscard]] RunLock prepare_run_directory(const std::filesystem::path& directory, bool force);

/// log.txt: lines with the time of day (UTC). A log that cannot be written is no reason to stop a run.
class RunLog {
 public:
  /// `append`: behind what the file holds already.
  explicit RunLog(const std::filesystem::path& file, bool append = false);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// One line or several.
  void line(const std::string& text);

 private:
  std::FILE* file_;
};

}  // namespace sluice
