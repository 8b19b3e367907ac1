#include "ci/cli/ledger_file.h"

#include <fmt/format.h>

#include <stdexcept>

namespace sluice::ci::cli {

void add_ledger_option(CLI::App& command, std::string& file) {
  command.add_option("--ledger", file, "The ledger's file")->capture_default_str()->envname("SLUICE_LEDGER");
}

Ledger open_ledger(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw std::runtime_error(fmt::format(
        "{}: no such ledger (make one with `ledger append`, or name another with --ledger)", file.string()));
  Ledger ledger = read_ledger(file);
  for (const DamagedLine& damaged : ledger.damaged)
    fmt::print(stderr, "ledger: warning: {}:{}: left out: {}\n", file.string(), damaged.line, damaged.problem);
  return ledger;
}

}  // namespace sluice::ci::cli
