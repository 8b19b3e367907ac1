#include "bench/roofline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace sluice::bench {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json entry(const std::string& name, int threads, double flops_s, double bytes_s, double flops_per_byte) {
  return {{"name", name + "/threads:" + std::to_string(threads)},
          {"run_type", "iteration"},
          {"threads", 1},
          {"omp_threads", threads},
          {"flops_per_second", flops_s},
          {"bytes_per_second", bytes_s},
          {"flops_per_byte", flops_per_byte}};
}

json results() {
  json r;
  r["context"] = {{"cpu", "A machine"}};
  r["benchmarks"] = {entry("machine/multiply_add_float", 1, 100e9, 0, 0),
                     entry("machine/multiply_add_double", 1, 50e9, 0, 0),
                     entry("machine/triad", 1, 0, 10e9, 0),
                     entry("wcsph/fluid_pairs/1e5", 1, 40e9, 2e9, 20),
                     entry("wcsph/fluid_pairs/1e5", 1, 44e9, 2.2e9, 20),
                     entry("mps/matrix_product/1e5", 1, 1e9, 4e9, 0.25),
                     entry("mps/matrix_product/1e5", 2, 2e9, 8e9, 0.25),
                     entry("mps/sensors/1e5", 1, 0, 0, 0)};
  return r;
}

TEST(Roofline, TakesTheFastestOfEachKernelThatCountsOperations) {
  const Roofline r = read_roofline(results(), 1);
  EXPECT_EQ(r.roofs.float_flops_s, 100e9);
  EXPECT_EQ(r.roofs.double_flops_s, 50e9);
  EXPECT_EQ(r.roofs.bytes_s, 10e9);
  ASSERT_EQ(r.kernels.size(), 2U);
  EXPECT_EQ(r.kernels[0].name, "wcsph/fluid_pairs");
  EXPECT_EQ(r.kernels[0].flops_s, 44e9);
  EXPECT_EQ(r.kernels[1].flops_s, 1e9);
  // 44 of 100 Gflop/s right of the ridge, 1 of 2.5 left of it.
  EXPECT_THAT(describe(r), testing::AllOf(HasSubstr("44 %"), HasSubstr("40 %")));
}

TEST(Roofline, SaysWhatIsMissing) {
  EXPECT_THROW(read_roofline(results(), 2), std::runtime_error);
  EXPECT_THROW(read_roofline(json::array(), 1), std::runtime_error);
}

TEST(Roofline, IsDrawn) {
  const auto folder = std::filesystem::temp_directory_path() / "sluice-roofline-test";
  std::stringstream svg;
  svg << std::ifstream(draw_roofline(read_roofline(results(), 1), folder)).rdbuf();
  EXPECT_THAT(svg.str(), testing::AllOf(HasSubstr("fluid pairs"), HasSubstr("matrix product"), HasSubstr("A machine")));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace sluice::bench
