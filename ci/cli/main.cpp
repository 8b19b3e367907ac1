#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "ci/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/manifest.h"
#include "validation/suggest.h"

namespace {

constexpr int usage_exit_code = 2;

const char* const description =
    "The ledger of accuracy and cost: what every night's runs and benchmarks measured, at which commit, and what has\n"
    "become worse since.";

const char* const examples =
    "Examples:\n"
    "  ledger append runs/nightly/*                       add runs\n"
    "  ledger append --this-build bench.json              add a benchmark's results\n"
    "  ledger check                                       exit code 1 when something has become worse\n"
    "  ledger accept --series 1f3a9c04 --reason \"why\"     live with it\n"
    "  ledger dashboard --out ledger.html                 one page with everything\n"
    "`ledger COMMAND --help` tells more about a command; ci/README.md explains the file.";

// CLI11 would only say that a command is required.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw sluice::cli::UsageError(fmt::format("unknown command `{}`{}", argv[1], sluice::suggestion(argv[1], names)));
}

int complain(const std::string& message, int exit_code) {
  fmt::print(stderr, "ledger: error: {}\n", message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  const auto& build = sluice::build_info();
  int exit_code = 0;
  CLI::App app(description, "ledger");
  app.footer(examples);
  app.set_version_flag("--version", fmt::format("ledger {} ({}; {})", build.version, build.commit, build.compiler));
  app.require_subcommand(1);
  sluice::ci::cli::add_append(app, exit_code);
  sluice::ci::cli::add_check(app, exit_code);
  sluice::ci::cli::add_accept(app, exit_code);
  sluice::ci::cli::add_dashboard(app, exit_code);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(std::string(error.what()) + " (see --help)", usage_exit_code);
  } catch (const sluice::cli::UsageError& error) {
    return complain(error.what(), usage_exit_code);
  } catch (const std::exception& error) {
    return complain(error.what(), 1);
  }
  return exit_code;
}
