#include "validation/file_hash.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace sluice {

std::string file_hash(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("{}: cannot be read; check the path and the permissions", path.string()));
  }
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return fmt::format("fnv1a64:{:016x}", fnv1a64(bytes));
}

}  // namespace sluice
