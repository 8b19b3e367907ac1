#include "validation/available_memory.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// The files in which a version of control groups tells of memory.
struct GroupFiles {
  const char* limit;
  const char* usage;
  const char* cache_prefix;  ///< of memory.stat's keys, that the groups below count in
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_"};
constexpr GroupFiles version_2{"memory.max", "memory.current", ""};

std::optional<std::int64_t> read_number(const fs::path& file) {
  std::ifstream in(file);
  std::int64_t value = 0;
  if (in >> value) return value;
  return std::nullopt;  // absent, or the word "max"
}

std::int64_t page_cache_bytes(const fs::path& group, const std::string& prefix) {
  std::ifstream in(group / "memory.stat");
  std::int64_t sum = 0;
  std::int64_t bytes = 0;
  for (std::string key; in >> key >> bytes;)
    if (key == prefix + "inactive_file" || key == prefix + "active_file") sum += bytes;
  return sum;
}

std::optional<std::int64_t> left_in(const fs::path& group, const GroupFiles& files) {
  const auto limit = read_number(group / files.limit);
  const auto usage = read_number(group / files.usage);
  if (!limit || !usage) return std::nullopt;
  const std::int64_t in_use = std::max<std::int64_t>(0, *usage - page_cache_bytes(group, files.cache_prefix));
  return std::max<std::int64_t>(0, *limit - in_use);
}

void take_least(std::optional<std::int64_t>& least, std::optional<std::int64_t> value) {
  if (value && (!least || *value < *least)) least = value;
}

/// Over a group and those around it. Inside a container the path may be the host's: then only the root is there.
void look_through(std::optional<std::int64_t>& least, const fs::path& root, const fs::path& group,
                  const GroupFiles& files) {
  fs::path here = root;
  take_least(least, left_in(here, files));
  for (const fs::path& part : group.relative_path()) take_least(least, left_in(here /= part, files));
}

std::optional<std::int64_t> system_available_bytes() {
  std::ifstream in("/proc/meminfo");
  for (std::string key, unit; in >> key;) {
    std::int64_t kibibytes = 0;
    in >> kibibytes >> unit;
    if (key == "MemAvailable:") return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::int64_t> group_available_bytes(const fs::path& root, const std::string& memberships) {
  std::optional<std::int64_t> least;
  std::istringstream lines(memberships);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    std::string controllers = line.substr(first, second - first);  // ":cpu,memory"
    controllers.front() = ',';
    controllers += ',';
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,") look_through(least, root, group, version_2);
    if (controllers.find(",memory,") != std::string::npos) look_through(least, root / "memory", group, version_1);
  }
  return least;
}

std::optional<std::int64_t> available_memory_bytes() {
  std::ifstream in("/proc/self/cgroup");
  const std::string memberships{std::istreambuf_iterator<char>(in), {}};
  std::optional<std::int64_t> least = system_available_bytes();
  take_least(least, group_available_bytes("/sys/fs/cgroup", memberships));
  return least;
}

}  // namespace sluice
