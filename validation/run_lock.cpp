#include "validation/run_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "validation/printable.h"

namespace sluice {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host.front() = '?';
  return fmt::format("process {} on {}\n", getpid(), host.data());
}

/// As its holder wrote it.
std::string holder(int descriptor) {
  std::array<char, 256> text{};
  const ssize_t length = pread(descriptor, text.data(), text.size(), 0);
  const std::string line(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  const std::string name = printable(line.substr(0, line.find('\n')));
  return name.empty() ? "another program" : name;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& directory)
    : descriptor_(open((directory / lock_file).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0)
    throw std::runtime_error(fmt::format("{}: cannot be opened: {} (a run needs to write into its directory)",
                                         (directory / lock_file).string(), std::generic_category().message(errno)));
  held_ = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  if (!held_ && errno == EWOULDBLOCK) {
    const std::string who = holder(descriptor_);
    close(descriptor_);
    throw NotNow(fmt::format("{}: {} computes here at this moment (wait until it has ended, or stop it)",
                             directory.string(), who));
  }
  const std::string text = this_process();
  // The name is a help for who is refused, not the lock.
  if (held_ && ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, text.data(), text.size(), 0) < 0) errno = 0;
}

RunLock::RunLock(RunLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), held_(std::exchange(other.held_, false)) {}

RunLock::~RunLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace sluice
