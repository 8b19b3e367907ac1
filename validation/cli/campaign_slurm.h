// `sluice campaign --engine slurm`: the jobs of a campaign, written and handed to sbatch.
#pragma once

#include <filesystem>

#include "validation/campaign.h"

namespace sluice::cli {

struct Submission {
  std::filesystem::path campaign;  ///< its file
  std::filesystem::path out;
  double checkpoint_every_s = 600;
  bool report = true;
  bool dry_run = false;  ///< print the scripts, write and submit nothing
};

/// Submits what is not finished as a job array, and a job behind it that makes the report. Scripts, logs and the jobs'
/// numbers are kept in out/slurm. Returns the exit code. Throws std::runtime_error when sbatch is not there or refuses,
/// or when jobs of an earlier submission have not ended yet.
int submit(const Campaign& campaign, const Submission& submission);

}  // namespace sluice::cli
