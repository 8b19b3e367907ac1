// The roofline figure: what kernels achieve, against what the machine was measured to be able to.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sluice::bench {

struct Roofs {
  double float_flops_s = 0;
  double double_flops_s = 0;
  double bytes_s = 0;
};

struct AchievedKernel {
  std::string name;  ///< without size and threads
  double flops_per_byte = 0;
  double flops_s = 0;
};

struct Roofline {
  int threads = 1;
  Roofs roofs;
  std::vector<AchievedKernel> kernels;
  std::string machine;  ///< for the title
};

/// From Google Benchmark's JSON of sluice_bench; of repeated benchmarks the fastest counts. Throws std::runtime_error
/// naming what is missing for this number of threads.
Roofline read_roofline(const nlohmann::json& results, int threads);

/// Writes roofline.svg, with the script and data it was drawn from, into a folder. Returns the picture's path.
std::filesystem::path draw_roofline(const Roofline& roofline, const std::filesystem::path& folder);

/// One line a kernel: rate, intensity, and its share of the roof above it.
std::string describe(const Roofline& roofline);

}  // namespace sluice::bench
