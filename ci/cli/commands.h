// The commands of `ledger`, one file each. Every function adds its command to the program; the command's callback does
// the work and sets `exit_code` (0 done, 1 failed or an open regression). Usage errors are CLI11's (2).
#pragma once

#include <CLI/CLI.hpp>

namespace sluice::ci::cli {

void add_append(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_accept(CLI::App& app, int& exit_code);
void add_dashboard(CLI::App& app, int& exit_code);

}  // namespace sluice::ci::cli
