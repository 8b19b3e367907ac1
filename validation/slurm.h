// Campaigns on a cluster: the batch scripts of a Slurm job array with one task a run, and of the job behind it that
// makes the report.
//
//   [slurm]                          # in a campaign's file; all of it may be left out
//   partition = "compute"            # default: the cluster's
//   time_limit = "12:00:00"          # of one task, as sbatch takes it; default: the partition's
//   threads = 8                      # processors of a task; default 1
//   at_once = 4                      # tasks at the same time; default: as many as there is room for
//   warning_s = 120                  # before its time limit a task is told to write a checkpoint
//   options = ["--account=hydro"]    # more of sbatch's, word for word
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

class TomlReader;

struct SlurmOptions {
  std::string partition;   ///< empty: the cluster's default
  std::string time_limit;  ///< empty: the partition's
  int threads = 1;
  int at_once = 0;  ///< 0: no bound
  int warning_s = 120;
  std::vector<std::string> options;
};

/// Throws CaseError at the key.
SlurmOptions parse_slurm(TomlReader reader);

/// "90", "30:00", "12:00:00", "2-12", "2-12:00" or "2-12:00:00", as sbatch reads them [s]; nullopt for anything else.
std::optional<double> time_limit_s(std::string_view text);

/// What is wrong with the options together, with the remedy; empty when nothing is.
std::string slurm_problem(const SlurmOptions& slurm);

/// What the scripts need to know; all paths absolute.
struct SlurmJob {
  std::string name;
  std::filesystem::path program;  ///< sluice, as the nodes find it
  std::filesystem::path campaign;
  std::filesystem::path out;
  std::filesystem::path working_directory;
  std::vector<std::string> runs;  ///< names of the run directories that are to be computed
  std::int64_t memory_bytes = 0;  ///< of the largest
  double checkpoint_every_s = 600;
  SlurmOptions options;
};

/// Throws std::runtime_error where a path cannot stand in a script's directives.
void refuse_odd_paths(const SlurmJob& job);

/// The script of the array. A task starts its run, goes on with it from its checkpoint, or ends at once when it is
/// finished. Before its time limit it writes a checkpoint and puts itself back into the queue.
std::string slurm_runs_script(const SlurmJob& job);

/// The script of the job that makes the report when all tasks have ended.
std::string slurm_report_script(const SlurmJob& job);

}  // namespace sluice
