#include "validation/cli/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <system_error>
#include <vector>

#include "validation/cli/usage_error.h"
#include "validation/manifest.h"
#include "validation/progress.h"
#include "validation/suggest.h"

namespace sluice::cli {

namespace {

constexpr int usage_exit_code = 2;

// CLI11 would only say that a command is required.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw UsageError(fmt::format("unknown command `{}`{}", argv[1], suggestion(argv[1], names)));
}

}  // namespace

int run_program(const ProgramText& text, AddCommands add_commands, int argc, char** argv) {
  const BuildInfo& build = build_info();
  const auto complain = [&](const std::string& message, int code) {
    tell(stderr, fmt::format("{}: error: {}\n", text.name, message));
    return code;
  };
  std::signal(SIGPIPE, SIG_IGN);  // who reads what is told may go; the computation does not end with it
  int exit_code = 0;
  CLI::App app(text.description, text.name);
  app.footer(text.examples);
  app.set_version_flag("--version",
                       fmt::format("{} {} ({}; {})", text.name, build.version, build.commit, build.compiler));
  app.require_subcommand(1);
  add_commands(app, exit_code);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(std::string(error.what()) + " (see --help)", usage_exit_code);
  } catch (const UsageError& error) {
    return complain(error.what(), usage_exit_code);
  } catch (const std::system_error& error) {
    return error.code() == std::errc::broken_pipe ? 1 : complain(error.what(), 1);
  } catch (const std::exception& error) {
    return complain(error.what(), 1);
  }
  return exit_code;
}

}  // namespace sluice::cli
