#include "ci/dashboard.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "ci/cli/commands.h"
#include "ci/cli/ledger_file.h"
#include "ci/findings.h"

namespace sluice::ci::cli {
namespace {

struct DashboardArguments {
  std::string ledger = default_ledger;
  std::string out = "runs/ledger.html";
};

int dashboard(const DashboardArguments& arguments) {
  const Ledger ledger = open_ledger(arguments.ledger);
  write_dashboard(arguments.out, ledger, find_all(ledger));
  fmt::print("ledger dashboard: {}\n", arguments.out);
  return 0;
}

}  // namespace

void add_dashboard(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("dashboard", "Write one page that shows every series, without network");
  auto arguments = std::make_shared<DashboardArguments>();
  add_ledger_option(*command, arguments->ledger);
  command->add_option("--out", arguments->out, "The page")->capture_default_str();
  command->footer(
      "Examples:\n"
      "  ledger dashboard\n"
      "  ledger dashboard --ledger nightly.jsonl --out site/index.html");
  command->callback([arguments, &exit_code] { exit_code = dashboard(*arguments); });
}

}  // namespace sluice::ci::cli
