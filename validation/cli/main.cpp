#include "validation/cli/commands.h"
#include "validation/cli/program.h"

namespace {

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

}  // namespace

int main(int argc, char** argv) {
  return sluice::cli::run_program({"sluice", description, examples}, add_commands, argc, argv);
}
