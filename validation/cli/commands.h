// The commands of `sluice`, one file each. Every function adds its command to the program; the command's callback does
// the work and sets `exit_code` (0 done, 1 failed, 128 + signal interrupted). Usage errors are CLI11's (2).
#pragma once

#include <CLI/CLI.hpp>

namespace sluice::cli {

void add_list(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_resume(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_campaign(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_data(CLI::App& app, int& exit_code);

}  // namespace sluice::cli
