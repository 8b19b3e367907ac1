// Draws the roofline figure from a file of results: roofline results.json --out bench/out
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "bench/roofline.h"

namespace {

nlohmann::json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot be read (give the file of --benchmark_out)");
  return nlohmann::json::parse(in);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Draws what kernels achieve against the machine's own peaks"};
  std::string results;
  std::string out = "build/release/bench-out";
  int threads = 1;
  app.add_option("RESULTS", results, "JSON written by sluice_bench")->required();
  app.add_option("--out", out, "Folder of the figure")->capture_default_str();
  app.add_option("--threads", threads, "Which benchmarks: those with so many threads")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const sluice::bench::Roofline roofline = sluice::bench::read_roofline(read_json(results), threads);
    fmt::print("{}", sluice::bench::describe(roofline));
    fmt::print("figure: {}\n", sluice::bench::draw_roofline(roofline, out).string());
  } catch (const std::exception& error) {
    fmt::print(stderr, "roofline: error: {}: {}\n", results, error.what());
    return 1;
  }
  return 0;
}
