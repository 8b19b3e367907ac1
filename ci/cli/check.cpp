#include <fmt/format.h>

#include <memory>

#include "ci/cli/commands.h"
#include "ci/cli/ledger_file.h"
#include "ci/summary.h"

namespace sluice::ci::cli {
namespace {

struct CheckArguments {
  std::string ledger = default_ledger;
  bool everything = false;
};

int check(const CheckArguments& arguments) {
  const Ledger ledger = open_ledger(arguments.ledger);
  const std::vector<SeriesFindings> all = find_all(ledger);
  fmt::print("{}", summary(all, arguments.everything));
  return count(all).open == 0 ? 0 : 1;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("check", "Say what has become worse; exit code 1 when something has");
  auto arguments = std::make_shared<CheckArguments>();
  add_ledger_option(*command, arguments->ledger);
  command->add_flag("--everything", arguments->everything,
                    "Also what is accepted, mended, better, or of a metric that raises no alarm");
  command->footer(
      "Examples:\n"
      "  ledger check\n"
      "  ledger check --everything --ledger nightly.jsonl");
  command->callback([arguments, &exit_code] { exit_code = check(*arguments); });
}

}  // namespace sluice::ci::cli
