#include "validation/manifest.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "solvers/bring_to_disk.h"

namespace sluice {

namespace {

/// The first value of a field of /proc/cpuinfo; empty when it is not there (other processors name other fields).
std::string cpu_field(const std::string& name) {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(name + "\t") && !line.starts_with(name + " ")) continue;
    const auto colon = line.find(": ");
    if (colon != std::string::npos && line.find_first_not_of("\t ", name.size()) == colon)
      return line.substr(colon + 2);
  }
  return "";
}

}  // namespace

bool names_one_build(std::string_view commit) {
  return !commit.empty() && commit != "unknown" && !commit.ends_with("-dirty");
}

std::string cpu_model() {
  const std::string model = cpu_field("model name");
  return model.empty() ? "unknown" : model;
}

std::string machine_fingerprint() {
  std::string text = cpu_model();
  const std::string family = cpu_field("cpu family");
  if (!family.empty()) text += fmt::format(" ({}/{}/{})", family, cpu_field("model"), cpu_field("stepping"));
  const double memory_bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return fmt::format("{}, {} processors, {:.0f} GiB", text, std::thread::hardware_concurrency(),
                     memory_bytes / (1024.0 * 1024 * 1024));
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

double cpu_time_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

void write_manifest(const std::filesystem::path& directory, const nlohmann::json& manifest) {
  const std::filesystem::path target = directory / "run.json";
  const std::filesystem::path half = directory / "run.json.tmp";
  std::ofstream out(half, std::ios::binary | std::ios::trunc);
  out << manifest.dump(2) << '\n';
  out.close();
  if (!out)
    throw std::runtime_error(fmt::format("{}: cannot be written: {} (free some space or choose another --out)",
                                         half.string(), std::strerror(errno)));
  bring_to_disk(half);  // or a power cut leaves an empty file in place of the old one
  std::error_code error;
  std::filesystem::rename(half, target, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be replaced: {}", target.string(), error.message()));
}

}  // namespace sluice
