#include "validation/run_log.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "validation/checkpoint.h"
#include "validation/manifest.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

// A manifest without a status is another code's; one that cannot be read may be anything. Neither is ours to remove.
std::string status_of(const fs::path& manifest_file) {
  std::ifstream in(manifest_file);
  const auto manifest = nlohmann::json::parse(in, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("status") || !manifest["status"].is_string()) return "unknown";
  return manifest["status"].get<std::string>();
}

/// Another code's, it may be, whose manifest is still to be written.
bool has_series(const fs::path& directory) {
  const fs::path file = directory / "probes.csv";
  return fs::is_regular_file(file) && fs::file_size(file) > 0;
}

void remove_old_run(const fs::path& directory) {
  // The checkpoint first: left behind, it would come to belong to the new run.
  for (const char* name : {checkpoint_file, "run.json", "probes.csv", "log.txt", "snapshots.pvd"})
    fs::remove(directory / name);
  if (!fs::is_directory(directory / "snapshots")) return;
  for (const auto& entry : fs::directory_iterator(directory / "snapshots"))
    if (entry.path().extension() == ".vtp") fs::remove(entry.path());
}

}  // namespace

RunLock prepare_run_directory(const fs::path& directory, bool force) {
  try {
    fs::create_directories(directory);
    RunLock lock(directory);
    const bool has_checkpoint = fs::exists(directory / checkpoint_file);
    if (!fs::exists(directory / "run.json") && !has_series(directory) && !has_checkpoint) return lock;
    const std::string status = status_of(directory / "run.json");
    if (!force && has_checkpoint)
      throw std::runtime_error(
          fmt::format("{}: holds a run that can go on, status {} (`sluice resume {}` does that; --force replaces it)",
                      directory.string(), status, directory.string()));
    if (!force && ((status != "failed" && status != "interrupted") || has_rows(directory)))
      throw std::runtime_error(
          fmt::format("{}: holds a run already, status {} (use --force to replace it, or choose another --out)",
                      directory.string(), status));
    remove_old_run(directory);
    return lock;
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error(fmt::format("{}: cannot be prepared for a run: {} (choose another --out)",
                                         directory.string(), error.code().message()));
  }
}

RunLog::RunLog(const fs::path& file, bool append) : file_(std::fopen(file.c_str(), append ? "a" : "w")) {}

RunLog::~RunLog() {
  if (file_ != nullptr) std::fclose(file_);
}

void RunLog::line(const std::string& text) {
  if (file_ == nullptr) return;
  std::istringstream lines(text);
  // fputs and not fmt::print, which throws when the disk is full.
  for (std::string one; std::getline(lines, one);) std::fputs(fmt::format("{} {}\n", utc_now(), one).c_str(), file_);
  std::fflush(file_);
}

}  // namespace sluice
