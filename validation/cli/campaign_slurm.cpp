#include "validation/cli/campaign_slurm.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "validation/plan.h"
#include "validation/printable.h"
#include "validation/slurm.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct Answer {
  int code = 0;
  std::string out;
};

/// What the command prints on its standard output; its standard error goes where ours goes.
Answer run_command(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start a shell to talk to Slurm");
  Answer answer;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) answer.out += buffer.data();
  const int state = pclose(pipe);
  answer.code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  return answer;
}

void require_slurm() {
  if (run_command("command -v sbatch && command -v squeue").code == 0) return;
  throw std::runtime_error(
      "--engine slurm: sbatch and squeue are not on the PATH (run this where Slurm jobs are submitted; on Debian the "
      "package slurm-client has them). --dry-run prints the scripts");
}

SlurmJob job_of(const Campaign& campaign, const Submission& submission) {
  SlurmJob job;
  job.name = campaign.name;
  job.program = fs::read_symlink("/proc/self/exe");
  job.campaign = fs::absolute(submission.campaign).lexically_normal();
  job.out = fs::absolute(submission.out).lexically_normal();
  job.working_directory = fs::current_path();
  job.checkpoint_every_s = submission.checkpoint_every_s;
  job.options = campaign.slurm;
  for (const CampaignRun& run : campaign.runs) {
    if (state_of(campaign, run) == CampaignState::finished) continue;
    job.runs.push_back(run.directory.filename().string());
    job.memory_bytes = std::max(job.memory_bytes, plan_run(campaign.case_of(run), run.settings).memory_bytes);
  }
  refuse_odd_paths(job);
  return job;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out)
    throw std::runtime_error(fmt::format("{}: cannot be written; check the folder and the disk", file.string()));
}

/// Two tasks of one run would write into one directory.
void refuse_queued(const fs::path& jobs_file) {
  const std::string jobs = contents(jobs_file);
  if (jobs.empty()) return;
  if (jobs.find_first_not_of("0123456789,\n") != std::string::npos)
    throw std::runtime_error(fmt::format("{}: is not a list of job numbers (remove it)", jobs_file.string()));
  const std::string list = jobs.substr(0, jobs.find('\n'));
  const Answer queue = run_command("squeue --noheader --format=%i --jobs=" + list + " 2>&1");
  // It fails on numbers that the cluster has forgotten, too.
  const bool forgotten = queue.code != 0 && queue.out.find("Invalid job id") != std::string::npos;
  if (forgotten || (queue.code == 0 && queue.out.empty())) return;
  if (queue.code != 0)
    throw std::runtime_error(
        fmt::format("squeue does not tell whether this campaign is in the queue already, as jobs {}: {} (try again "
                    "when it answers)",
                    list, printable(queue.out.substr(0, queue.out.find('\n')))));
  throw std::runtime_error(
      fmt::format("this campaign is in the queue already, as jobs {} (wait for them, or `scancel {}`; then the same "
                  "command goes on)",
                  list, list));
}

/// The job's number.
std::string submit_script(const fs::path& script, const std::string& dependency) {
  const Answer answer = run_command(fmt::format("sbatch --parsable {} {}", dependency, shell_quoted(script.string())));
  std::string number = answer.out.substr(0, answer.out.find_first_of(";\n"));
  if (answer.code != 0 || number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
    throw std::runtime_error(fmt::format("{}: sbatch did not take it (its words are above)", script.string()));
  return number;
}

}  // namespace

int submit(const Campaign& campaign, const Submission& submission) {
  const SlurmJob job = job_of(campaign, submission);
  if (submission.dry_run) {
    if (!job.runs.empty()) fmt::print("{}", slurm_runs_script(job));
    if (submission.report) fmt::print("\n{}", slurm_report_script(job));
    return 0;
  }
  if (job.runs.empty() && !submission.report) {
    fmt::print("nothing to submit: finished already\n");
    return 0;
  }
  require_slurm();
  const fs::path folder = job.out / "slurm";
  fs::create_directories(folder);
  refuse_queued(folder / "jobs.txt");
  std::string jobs;
  if (!job.runs.empty()) {
    write(folder / "runs.sh", slurm_runs_script(job));
    jobs = submit_script(folder / "runs.sh", "");
    write(folder / "jobs.txt", jobs + "\n");
    fmt::print("job {}: {} runs, one a task\n", jobs, job.runs.size());
  }
  if (submission.report) {
    write(folder / "report.sh", slurm_report_script(job));
    const std::string after = jobs.empty() ? "" : "--dependency=afterany:" + jobs;
    const std::string report = submit_script(folder / "report.sh", after);
    jobs += jobs.empty() ? report : "," + report;
    write(folder / "jobs.txt", jobs + "\n");
    fmt::print("job {}: the report, when they have ended\n", report);
  }
  if (!jobs.empty()) fmt::print("`squeue --jobs={}` shows them; they log into {}\n", jobs, folder.string());
  return 0;
}

}  // namespace sluice::cli
