#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/manifest.h"
#include "validation/suggest.h"

namespace {

constexpr int usage_exit_code = 2;

const char* const description =
    "Sluice: a validation bench for free-surface particle solvers. Runs a case, measures it against the experiment, "
    "and\n"
    "reports the comparison.";

const char* const examples =
    "Examples:\n"
    "  sluice validate --tier quick           run, compare, report, and judge by the acceptance bands\n"
    "  sluice run kleefsman --l0 0.02         one run, into runs/\n"
    "  sluice resume runs/DIRECTORY           go on with a run that was interrupted or killed\n"
    "  sluice report runs/*                   compare runs that are there\n"
    "`sluice COMMAND --help` tells more about a command.";

void add_commands(CLI::App& app, int& exit_code) {
  sluice::cli::add_list(app, exit_code);
  sluice::cli::add_run(app, exit_code);
  sluice::cli::add_resume(app, exit_code);
  sluice::cli::add_validate(app, exit_code);
  sluice::cli::add_campaign(app, exit_code);
  sluice::cli::add_compare(app, exit_code);
  sluice::cli::add_report(app, exit_code);
  sluice::cli::add_data(app, exit_code);
}

// CLI11 would only say that a command is required.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw sluice::cli::UsageError(fmt::format("unknown command `{}`{}", argv[1], sluice::suggestion(argv[1], names)));
}

int complain(const std::string& message, int exit_code) {
  fmt::print(stderr, "sluice: error: {}\n", message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  const auto& build = sluice::build_info();
  int exit_code = 0;
  CLI::App app(description, "sluice");
  app.footer(examples);
  app.set_version_flag("--version", fmt::format("sluice {} ({}; {})", build.version, build.commit, build.compiler));
  app.require_subcommand(1);
  add_commands(app, exit_code);
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
