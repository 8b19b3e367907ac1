#include "validation/file_hash.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <vector>

namespace sluice {

namespace {

std::string as_text(std::uint64_t hash) {
  return fmt::format("fnv1a64:{:016x}", hash);
}

}  // namespace

std::string text_hash(std::string_view bytes) {
  return as_text(fnv1a64(bytes));
}

std::string file_hash(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("{}: cannot be read; check the path and the permissions", path.string()));
  }
  std::vector<char> block(1 << 20);
  std::uint64_t hash = fnv1a64("");
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash = fnv1a64({block.data(), static_cast<std::size_t>(file.gcount())}, hash);
  }
  return as_text(hash);
}

}  // namespace sluice
