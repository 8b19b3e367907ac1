#include "solvers/bring_to_disk.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace sluice {

void bring_to_disk(const std::filesystem::path& file_or_folder) {
  const int descriptor = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS);
  const int cause = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (done) return;
  throw std::runtime_error(
      fmt::format("{}: cannot be brought to disk ({}); free space on that disk or write to another one",
                  file_or_folder.string(), std::generic_category().message(cause)));
}

}  // namespace sluice
