#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ci/cli/commands.h"
#include "ci/cli/ledger_file.h"
#include "ci/from_benchmark.h"
#include "ci/from_run.h"
#include "ci/ledger.h"
#include "validation/cli/usage_error.h"
#include "validation/manifest.h"

namespace sluice::ci::cli {
namespace {

namespace fs = std::filesystem;

struct AppendArguments {
  std::string ledger = default_ledger;
  std::vector<std::string> sources;
  Provenance given;
  std::string link_base;
  bool this_build = false;
};

/// From this program for what was not given: it was built from the same tree, on the same machine.
void fill_from_this_build(Provenance& given) {
  const BuildInfo& build = build_info();
  const auto fill = [](std::string& field, const std::string& value) {
    if (field.empty()) field = value;
  };
  fill(given.commit, build.commit);
  fill(given.machine, machine_fingerprint());
  fill(given.compiler, build.compiler);
  fill(given.flags, build.flags);
}

std::vector<Result> results_of(const fs::path& source, const AppendArguments& arguments) {
  Provenance given = arguments.given;
  if (!arguments.link_base.empty()) {
    const fs::path clean = fs::absolute(source).lexically_normal();
    const fs::path name = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
    given.link = arguments.link_base + (arguments.link_base.ends_with('/') ? "" : "/") + name.string();
  }
  return fs::is_directory(source) ? results_of_run(source, given) : results_of_benchmark(source, given);
}

/// Sources that cannot be used do not keep the others out.
int append(AppendArguments& arguments) {
  if (!arguments.given.date.empty() && !is_date(arguments.given.date))
    throw sluice::cli::UsageError(
        fmt::format("--date: `{}` is not a date such as 2026-11-25T09:34:08Z", arguments.given.date));
  if (arguments.this_build) fill_from_this_build(arguments.given);
  std::vector<Result> results;
  int failures = 0;
  for (const std::string& source : arguments.sources) {
    try {
      const std::vector<Result> own = results_of(source, arguments);
      results.insert(results.end(), own.begin(), own.end());
    } catch (const std::exception& error) {
      fmt::print(stderr, "ledger: error: {}: left out: {}\n", source, error.what());
      ++failures;
    }
  }
  const Appended appended = append_results(arguments.ledger, results);
  fmt::print("ledger append: {} results added to {}", appended.results, arguments.ledger);
  if (appended.known_runs > 0) fmt::print("; {} runs were there already", appended.known_runs);
  fmt::print("\n");
  return failures == 0 ? 0 : 1;
}

}  // namespace

void add_append(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("append", "Add the results of runs and benchmarks");
  auto arguments = std::make_shared<AppendArguments>();
  command
      ->add_option("SOURCE", arguments->sources,
                   "Run directories, and files that Google Benchmark wrote in its JSON form")
      ->required();
  add_ledger_option(*command, arguments->ledger);
  command->add_option("--commit", arguments->given.commit, "Commit (default: as the source says)");
  command->add_option("--date", arguments->given.date,
                      "Date, UTC, as 2026-11-25T09:34:08Z (default: as the source says)");
  command->add_option("--machine", arguments->given.machine, "Machine (default: as the source says)");
  command->add_option("--compiler", arguments->given.compiler, "Compiler (default: as the source says)");
  command->add_option("--flags", arguments->given.flags, "Compiler's flags (default: as the source says)");
  command->add_flag(
      "--this-build", arguments->this_build,
      "Take commit, machine, compiler and flags from this program: for benchmarks built with it and run here");
  command->add_option(
      "--link-base", arguments->link_base,
      "Where people find the sources: the link is this, \"/\" and the source's name (default: its path)");
  command->footer(
      "A run that is in the ledger already is left as it is (another code's is told by its files, --commit and "
      "--date).\n"
      "A run that failed is recorded as not finished.\n"
      "Examples:\n"
      "  ledger append runs/quick/kleefsman-*\n"
      "  ledger append --link-base https://example.org/quick runs/quick/kleefsman-*\n"
      "  ledger append --commit v2.1 --date 2026-11-25T00:00:00Z --machine host runs/another-code\n"
      "  ledger append --this-build bench.json");
  command->callback([arguments, &exit_code] { exit_code = append(*arguments); });
}

}  // namespace sluice::ci::cli
