#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "reports/analysis.h"
#include "reports/report.h"
#include "validation/acceptance.h"
#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/foreign.h"
#include "validation/printable.h"
#include "validation/progress.h"
#include "validation/run_directory.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  std::vector<std::string> sources;
  std::string case_name;
  std::string out = "reports/out";
  std::string bands;
  ReportOptions options;
  bool no_figures = false;
};

/// Run directories as they are; maps of foreign files become run directories below the report.
std::vector<fs::path> run_directories(const CompareArguments& arguments) {
  std::vector<fs::path> directories;
  std::set<std::string> names;
  for (const std::string& source : arguments.sources) {
    if (fs::path(source).extension() != ".toml") {
      directories.emplace_back(source);
      continue;
    }
    const std::string name = fs::path(source).stem().string();
    if (!names.insert(name).second)
      throw UsageError(fmt::format("{}: another map is called {} too (rename one)", source, name));
    directories.push_back(fs::path(arguments.out) / "imported" / name);
    import_foreign(load_foreign_map(source), directories.back());
    fmt::print(stderr, "{}: read into {}\n", source, directories.back().string());
  }
  return directories;
}

/// What the report says of its runs too: wrong units show here first.
void tell_warnings(const ReportData& data) {
  constexpr std::size_t longest = 1000;  // of what may quote a manifest
  for (const AnalysedRun& run : data.runs) {
    std::vector<std::string> warnings = run.record.warnings();
    warnings.insert(warnings.end(), run.problems.begin(), run.problems.end());
    for (const std::string& warning : warnings)
      tell(stderr, fmt::format("sluice: warning: {} ({}): {}\n", run.key, printable(run.record.path.string(), longest),
                               printable(warning, longest)));
  }
}

/// A name that is written otherwise than in the runs is the likely reason.
void tell_unjudged(const ReportData& data, const std::string& bands) {
  std::set<std::string> named;
  std::set<std::string> there;
  for (const AcceptanceRow& row : data.the_case.acceptance)
    if (row.file == bands) named.insert(printable(row.solver));
  for (const AnalysedRun& run : data.runs) there.insert(printable(run.record.solver));
  tell(stdout, fmt::format("{}: no row applies to any of these runs (it names solver {}; these are {})\n", bands,
                           fmt::join(named, ", "), fmt::join(there, ", ")));
}

/// The rows of a file of bands on every run that they speak of. False where one is not passed, or where they speak of
/// none.
bool print_bands(const ReportData& data, const std::string& bands) {
  bool passed = true;
  bool judged = false;
  for (const AnalysedRun& run : data.runs) {
    std::vector<AcceptanceCheck> checks;
    for (const AcceptanceCheck& check : run.acceptance)
      if (check.row.file == bands && check.verdict != AcceptanceVerdict::not_applicable) checks.push_back(check);
    if (checks.empty()) continue;
    judged = true;
    passed = passed && all_passed(checks);
    tell(stdout, fmt::format("{}: {}\n{}{}\n", printable(run.record.path.string()), printable(run.record.label()),
                             acceptance_table(checks), verdict_text(checks)));
  }
  if (!judged) tell_unjudged(data, bands);
  return passed && judged;
}

int compare(CompareArguments& arguments) {
  const std::vector<fs::path> directories = run_directories(arguments);
  if (!arguments.case_name.empty()) {
    const std::string wanted = load_case(arguments.case_name).name;
    for (const fs::path& directory : directories)
      if (const RunRecord run = read_run(directory); run.case_name != wanted)
        throw UsageError(fmt::format("{}: is of the case {}, not {}", directory.string(), run.case_name, wanted));
  }
  arguments.options.figures = !arguments.no_figures;
  const ReportData data = analyse(directories, arguments.bands);
  tell_warnings(data);
  write_analysed(data, arguments.out, arguments.options);
  const bool passed = arguments.bands.empty() || print_bands(data, arguments.bands);
  tell(stdout, fmt::format("report: {}\n", (fs::path(arguments.out) / "index.html").string()));
  return passed ? 0 : 1;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "Compare results of any code with the experiment and with runs");
  auto arguments = std::make_shared<CompareArguments>();
  command
      ->add_option(
          "SOURCE", arguments->sources,
          "Run directories (run.json with case, solver, l0_m; probes.csv with t_s, P1_Pa, ...), or maps of files\n"
          "in another form (a .toml file; the form stands in validation/foreign.h and in the README)")
      ->required();
  command->add_option("--case", arguments->case_name, "Refuse sources of any other case");
  command->add_option("--out", arguments->out, "Directory of the report")->capture_default_str();
  command->add_option(
      "--bands", arguments->bands,
      "Acceptance rows of a code's own (a .toml file with [[acceptance]] groups, as the case files have):"
      "\nexit code 1 when one is not passed");
  command->add_option("--title", arguments->options.title, "Title (default: the case's)");
  command->add_flag("--no-figures", arguments->no_figures, "Tables and text only (gnuplot is not needed)");
  command->footer(
      "Examples:\n"
      "  sluice compare my-run runs/kleefsman-* --case kleefsman\n"
      "  sluice compare gauges.toml --out reports/mine\n"
      "  sluice compare my-run --bands bands.toml --no-figures");
  command->callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace sluice::cli
