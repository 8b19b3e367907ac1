#include "ci/cli/commands.h"
#include "validation/cli/program.h"

namespace {

const char* const description =
    "The ledger of accuracy and cost: what every night's runs and benchmarks measured, at which commit, and what has\n"
    "become worse since.";

const char* const examples =
    "Examples:\n"
    "  ledger append runs/quick/kleefsman-*               add runs\n"
    "  ledger append --this-build bench.json              add a benchmark's results\n"
    "  ledger check                                       exit code 1 when something has become worse\n"
    "  ledger accept --series 1f3a9c04 --reason \"why\"     live with it\n"
    "  ledger dashboard --out ledger.html                 one page with everything\n"
    "`ledger COMMAND --help` tells more about a command; ci/README.md explains the file.";

void add_commands(CLI::App& app, int& exit_code) {
  sluice::ci::cli::add_append(app, exit_code);
  sluice::ci::cli::add_check(app, exit_code);
  sluice::ci::cli::add_accept(app, exit_code);
  sluice::ci::cli::add_dashboard(app, exit_code);
}

}  // namespace

int main(int argc, char** argv) {
  return sluice::cli::run_program({"ledger", description, examples}, add_commands, argc, argv);
}
