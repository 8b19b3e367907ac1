#include "bench/roofline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reports/plot.h"

namespace sluice::bench {
namespace {

using nlohmann::json;

constexpr double giga = 1e-9;

double number(const json& entry, const char* key) {
  const auto found = entry.find(key);
  return found != entry.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// "wcsph/fluid_pairs" of "wcsph/fluid_pairs/1e5/threads:1/real_time".
std::string kernel_name(const std::string& full) {
  const auto first = full.find('/');
  const auto second = full.find('/', first + 1);
  return full.substr(0, second);
}

void raise(double& value, double candidate) {
  value = std::max(value, candidate);
}

void take_machine(const json& entry, const std::string& name, Roofs& roofs) {
  if (name == "machine/multiply_add_float") raise(roofs.float_flops_s, number(entry, "flops_per_second"));
  if (name == "machine/multiply_add_double") raise(roofs.double_flops_s, number(entry, "flops_per_second"));
  if (name == "machine/triad") raise(roofs.bytes_s, number(entry, "bytes_per_second"));
}

void take_kernel(const json& entry, const std::string& name, std::vector<AchievedKernel>& kernels) {
  const AchievedKernel k{name, number(entry, "flops_per_byte"), number(entry, "flops_per_second")};
  if (k.flops_per_byte <= 0 || k.flops_s <= 0) return;
  const auto same = std::find_if(kernels.begin(), kernels.end(), [&](const auto& o) { return o.name == name; });
  if (same == kernels.end())
    kernels.push_back(k);
  else if (k.flops_s > same->flops_s)
    *same = k;
}

double roof_at(const Roofs& roofs, double peak_flops_s, double flops_per_byte) {
  return std::min(peak_flops_s, roofs.bytes_s * flops_per_byte);
}

PlotCurve roof_curve(const Roofs& roofs, double peak_flops_s, const std::string& label, CurveLook look,
                     const PlotRange& x) {
  PlotCurve curve;
  curve.label = label;
  curve.look = look;
  const double ridge = peak_flops_s / roofs.bytes_s;
  for (const double at : {*x.first, std::clamp(ridge, *x.first, *x.second), *x.second}) {
    curve.x.push_back(at);
    curve.y.push_back(giga * roof_at(roofs, peak_flops_s, at));
  }
  return curve;
}

/// Points lie close together, so they bear numbers, and the legend says whose.
PlotCurve kernel_curve(const AchievedKernel& kernel, std::size_t number) {
  PlotCurve curve;
  const bool wcsph = kernel.name.starts_with("wcsph/");
  std::string words = (wcsph ? "WCSPH " : "MPS ") + kernel.name.substr(kernel.name.find('/') + 1);
  std::replace(words.begin(), words.end(), '_', ' ');
  curve.label = fmt::format("{}  {}", number, words);
  curve.style = wcsph ? 0 : 1;
  curve.points_only = true;
  curve.x = {kernel.flops_per_byte};
  curve.y = {giga * kernel.flops_s};
  curve.point_labels = {fmt::format("{}", number)};
  return curve;
}

/// Both axes hold the ridge, the flat roof and every kernel.
void set_ranges(const Roofline& r, PlotPanel& panel) {
  panel.log_x = panel.log_y = true;
  double least_x = 0.1;
  double least_y = 1;
  for (const AchievedKernel& k : r.kernels) {
    least_x = std::min(least_x, k.flops_per_byte / 2);
    least_y = std::min(least_y, giga * k.flops_s / 2);
  }
  panel.x_range = {least_x, 8 * r.roofs.float_flops_s / r.roofs.bytes_s};
  panel.y_range = {least_y, 3 * giga * r.roofs.float_flops_s};
}

}  // namespace

Roofline read_roofline(const json& results, int threads) {
  if (!results.is_object() || !results.contains("benchmarks") || !results["benchmarks"].is_array())
    throw std::runtime_error("no `benchmarks` in it (write it with --benchmark_out=FILE --benchmark_out_format=json)");
  Roofline r;
  r.threads = threads;
  for (const json& entry : results["benchmarks"]) {
    if (entry.value("run_type", "") == "aggregate" || number(entry, "omp_threads") != threads) continue;
    const std::string name = kernel_name(entry.value("name", ""));
    take_machine(entry, name, r.roofs);
    if (!name.starts_with("machine/")) take_kernel(entry, name, r.kernels);
  }
  if (r.roofs.float_flops_s <= 0 || r.roofs.double_flops_s <= 0 || r.roofs.bytes_s <= 0)
    throw std::runtime_error(
        fmt::format("the machine's peaks with {} threads are missing (run sluice_bench with them)", threads));
  if (r.kernels.empty()) throw std::runtime_error(fmt::format("no kernel with {} threads counts operations", threads));
  if (results.contains("context")) r.machine = results["context"].value("cpu", "");
  return r;
}

std::filesystem::path draw_roofline(const Roofline& r, const std::filesystem::path& folder) {
  PlotPanel panel;
  panel.title =
      fmt::format("{}{}{} thread{}", r.machine, r.machine.empty() ? "" : ", ", r.threads, r.threads > 1 ? "s" : "");
  panel.x_label = "Arithmetic intensity [flop / byte]";
  panel.y_label = "Gflop / s";
  set_ranges(r, panel);
  panel.curves.push_back(roof_curve(
      r.roofs, r.roofs.float_flops_s,
      fmt::format("float: {:.0f} Gflop/s, {:.1f} GB/s", giga * r.roofs.float_flops_s, giga * r.roofs.bytes_s),
      CurveLook::experiment, panel.x_range));
  panel.curves.push_back(roof_curve(r.roofs, r.roofs.double_flops_s,
                                    fmt::format("double: {:.0f} Gflop/s", giga * r.roofs.double_flops_s),
                                    CurveLook::published, panel.x_range));
  for (std::size_t k = 0; k < r.kernels.size(); ++k) panel.curves.push_back(kernel_curve(r.kernels[k], k + 1));
  PlotFigure figure;
  figure.name = "roofline";
  figure.panel_width_px = 860;
  figure.panel_height_px = 520;
  figure.source = "Kernels of sluice_bench against the machine's own peaks; bench/README.md says what is counted";
  figure.panels.push_back(panel);
  return draw(figure, folder);
}

std::string describe(const Roofline& r) {
  std::string text = fmt::format("{:32} {:>10} {:>10} {:>14}\n", "kernel", "flop/byte", "Gflop/s", "share of roof");
  for (const AchievedKernel& k : r.kernels)
    text += fmt::format("{:32} {:10.2f} {:10.2f} {:12.0f} %\n", k.name, k.flops_per_byte, giga * k.flops_s,
                        100 * k.flops_s / roof_at(r.roofs, r.roofs.float_flops_s, k.flops_per_byte));
  return text;
}

}  // namespace sluice::bench
