#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "validation/case.h"
#include "validation/cli/commands.h"
#include "validation/measurements.h"

namespace sluice::cli {
namespace {

std::string join_names(const Case& c, SensorKind kind) {
  std::string names;
  for (const CaseSensor& sensor : c.sensors)
    if (sensor.kind == kind) names += (names.empty() ? "" : " ") + sensor.name;
  return names;
}

std::string solvers_of(const Case& c) {
  std::string text;
  for (const SolverOption& solver : c.solvers) {
    text += (text.empty() ? "" : "; ") + solver.name + " (walls:";
    for (const WallOption& walls : solver.walls)
      text += " " + walls.name + (walls.name == solver.default_walls ? "*" : "");
    text += ")";
  }
  return text;
}

std::string tiers_of(const Case& c) {
  std::string text;
  for (const Tier& tier : c.tiers)
    text += fmt::format("{}{} (l0 = {:g} m)", text.empty() ? "" : ", ", tier.name, tier.l0_m);
  return text;
}

std::string measured_of(const Case& c) {
  std::string text;
  for (const MeasuredFile& file : measured_files(c))
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", file.path.generic_string(),
                        file.present() ? "present" : "missing");
  return text.empty() ? "none" : text;
}

void print_case(const Case& c) {
  fmt::print("{}: {}\n", c.name, c.title);
  for (const auto& [title, kind] :
       {std::pair("wave probes", SensorKind::wave_height), std::pair("pressure sensors", SensorKind::pressure),
        std::pair("forces", SensorKind::force), std::pair("velocity probes", SensorKind::velocity)})
    if (const std::string names = join_names(c, kind); !names.empty())
      fmt::print("  {:<17} {}\n", title + std::string(":"), names);
  fmt::print("  measured series:  {}\n", measured_of(c));
  fmt::print("  solvers:          {}\n", solvers_of(c));
  fmt::print("  tiers:            {}\n", tiers_of(c));
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("list", "List the cases, with sensors and measured data");
  command->footer("Example:\n  sluice list");
  command->callback([&exit_code] {
    for (const std::string& name : case_names()) print_case(load_case(name));
    if (case_names().empty()) throw CaseError(fmt::format("no case in {}", case_directory().string()));
    exit_code = 0;
  });
}

}  // namespace sluice::cli
