// What the project's programs have in common: commands of one level, messages on stderr, exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sluice::cli {

struct ProgramText {
  std::string name;
  std::string description;
  std::string examples;
};

/// Adds every command of a program; their callbacks set the exit code.
using AddCommands = void (*)(CLI::App& app, int& exit_code);

/// The whole of a program: 0 done, 1 failed, 2 usage, or what a command has set.
int run_program(const ProgramText& text, AddCommands add_commands, int argc, char** argv);

}  // namespace sluice::cli
