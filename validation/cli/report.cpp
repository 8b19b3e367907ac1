#include "reports/report.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "validation/cli/commands.h"

namespace sluice::cli {
namespace {

struct ReportArguments {
  std::vector<std::string> runs;
  std::string out = "reports/out";
  ReportOptions options;
  bool no_figures = false;
  bool no_snapshots = false;
};

int report(ReportArguments& arguments) {
  arguments.options.figures = !arguments.no_figures;
  arguments.options.snapshots = !arguments.no_snapshots;
  write_report({arguments.runs.begin(), arguments.runs.end()}, arguments.out, arguments.options);
  fmt::print("report: {}\n", (std::filesystem::path(arguments.out) / "index.html").string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("report", "Compare runs with the experiment and with each other");
  auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("DIR", arguments->runs, "Run directories, of one case; another code's need probes.csv and run.json")
      ->required();
  command->add_option("--out", arguments->out, "Directory of the report")->capture_default_str();
  command->add_option("--title", arguments->options.title, "Title (default: the case's)");
  command->add_flag("--no-figures", arguments->no_figures, "Tables and text only (gnuplot is not needed)");
  command->add_flag("--no-snapshots", arguments->no_snapshots, "Leave out the particle pictures");
  command->footer(
      "Examples:\n"
      "  sluice report runs/kleefsman-wcsph-extrapolated-l0.020-alpha0.01\n"
      "  sluice report runs/* --out reports/all");
  command->callback([arguments, &exit_code] { exit_code = report(*arguments); });
}

}  // namespace sluice::cli
