// A fingerprint of a file's bytes, for manifests: to tell whether two runs were scored against the same data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sluice {

/// 64-bit FNV-1a. It tells files apart that differ by accident; it is no protection against forgery.
/// `hash` is that of the bytes before.
constexpr std::uint64_t fnv1a64(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  return hash;
}

/// "fnv1a64:" and 16 hexadecimal digits.
std::string text_hash(std::string_view bytes);

/// The same of a file's bytes. Throws std::runtime_error naming the file when it cannot be read.
std::string file_hash(const std::filesystem::path& path);

}  // namespace sluice
