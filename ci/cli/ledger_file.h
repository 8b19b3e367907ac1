// The ledger's file as commands name and open it.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "ci/ledger.h"

namespace sluice::ci::cli {

/// Relative to the working directory, beside the runs.
inline const std::string default_ledger = "runs/ledger.jsonl";

/// The option --ledger (environment: SLUICE_LEDGER).
void add_ledger_option(CLI::App& command, std::string& file);

/// Reads a ledger that must be there, and tells its damaged lines on stderr. Throws std::runtime_error as
/// read_ledger(), or when there is no such file.
Ledger open_ledger(const std::filesystem::path& file);

}  // namespace sluice::ci::cli
