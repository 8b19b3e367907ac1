// The state of a run in one HDF5 file, from which the run can go on as if it had never stopped.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "solvers/solver.h"

namespace sluice {

inline constexpr int checkpoint_schema = 1;
inline constexpr const char* checkpoint_file = "checkpoint.h5";

/// Writes `header` (whatever the harness wants to remember) and the solver's state. A reader sees the old file or the
/// new one, whatever happens in between: the new one is written beside it, brought to disk and renamed.
/// Throws std::runtime_error naming the file (full disk, no permission); an older checkpoint is then still there.
void write_checkpoint(const std::filesystem::path& file, const nlohmann::json& header, Solver& solver);

/// The header alone. Throws std::runtime_error naming the file, what is wrong with it (none there, cut short, damaged,
/// not a checkpoint, of another version) and the remedy.
nlohmann::json read_checkpoint_header(const std::filesystem::path& file);

/// Restores the state into a solver of the same scene and parameters. Throws as above.
void restore_checkpoint(const std::filesystem::path& file, Solver& solver);

}  // namespace sluice
