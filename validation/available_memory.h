// How much memory a new run may take: what the system has to give, within what control groups allow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sluice {

/// Memory [bytes] that the machine can give, or the control groups of this process if that is less; nothing where the
/// system does not tell.
std::optional<std::int64_t> available_memory_bytes();

/// What the control groups leave [bytes]: the least of limit - usage over those that `memberships` (of the form of
/// /proc/self/cgroup, version 1 or 2) names, and over the groups around them up to `root` (/sys/fs/cgroup). The page
/// cache counts as free, since the kernel gives it back. Nothing where no group has a limit.
std::optional<std::int64_t> group_available_bytes(const std::filesystem::path& root, const std::string& memberships);

}  // namespace sluice
