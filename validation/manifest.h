// The write side of run.json: provenance and an atomic write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sluice {

/// Names in run.json that other people's scripts rely on do not change without a new number.
inline constexpr int manifest_schema = 1;

/// What this program was built from and with; `commit` is that of the last build, with "-dirty" for uncommitted
/// changes.
struct BuildInfo {
  std::string commit;
  std::string compiler;
  std::string flags;
  std::string version;
  std::filesystem::path source_root;
};
const BuildInfo& build_info();

/// Whether a commit, as in BuildInfo, tells what a program was built from: an unknown one may be any, and "-dirty"
/// stands for whatever changes.
bool names_one_build(std::string_view commit);

/// The processor's model name as the system gives it, or "unknown".
std::string cpu_model();

/// What tells this machine from another one where times are compared: processor (with family, model and stepping, since
/// virtual machines give it general names), logical processors that this process may use, and memory.
std::string machine_fingerprint();

/// Largest resident memory of this process so far [bytes].
std::int64_t peak_memory_bytes();

/// Processor time of this process so far, all threads, user and system [s].
double cpu_time_s();

/// Now, as 2025-01-31T12:00:00Z.
std::string utc_now();

/// Writes `manifest` to directory/run.json so that a reader sees the old file or the new one, never half of one.
/// Throws std::runtime_error naming the file (full disk, no permission).
void write_manifest(const std::filesystem::path& directory, const nlohmann::json& manifest);

}  // namespace sluice
