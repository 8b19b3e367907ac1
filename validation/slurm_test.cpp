#include "validation/slurm.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "validation/campaign.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string campaign_text(const std::string& slurm) {
  return "name = \"x\"\n[[runs]]\ncase = \"kleefsman\"\nsolver = \"mps\"\nl0_m = [0.05]\n[slurm]\n" + slurm;
}

SlurmOptions options(const std::string& slurm) {
  return parse_campaign(campaign_text(slurm), "c.toml", "runs", 1).slurm;
}

std::string refusal(const std::string& slurm) {
  try {
    options(slurm);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Slurm, OptionsStandInTheCampaign) {
  const SlurmOptions o = options(
      "partition = \"compute\"\ntime_limit = \"2-12\"\nthreads = 8\nat_once = 4\n"
      "warning_s = 300\noptions = [\"--account=hydro\"]\n");
  EXPECT_EQ(o.partition, "compute");
  EXPECT_EQ(o.time_limit, "2-12");
  EXPECT_EQ(o.threads, 8);
  EXPECT_EQ(o.at_once, 4);
  EXPECT_EQ(o.warning_s, 300);
  EXPECT_THAT(o.options, testing::ElementsAre("--account=hydro"));
  EXPECT_EQ(options("").threads, 1);
}

TEST(Slurm, OptionsThatCannotBeAreRefused) {
  EXPECT_THAT(refusal("queue = \"x\"\n"), HasSubstr("c.toml:7: slurm.queue: unknown key"));
  EXPECT_THAT(refusal("threads = 0\n"), HasSubstr("c.toml:7: slurm.threads: is 0, must be 1 to 1024"));
  EXPECT_THAT(refusal("time_limit = \"soon\"\n"),
              AllOf(HasSubstr("c.toml:6: slurm: time limit `soon`"), HasSubstr("12:00:00")));
  EXPECT_THAT(refusal("time_limit = \"2\"\n"), HasSubstr("leaves no time before the warning at 120 s"));
  EXPECT_THAT(refusal("partition = \"a\\n#SBATCH --wrap=rm\"\n"), HasSubstr("cannot be one's name"));
  EXPECT_THAT(refusal("options = [\"--comment=a b\"]\n"), HasSubstr("without blanks and quotes"));
}

TEST(Slurm, TimeLimitsAreReadAsSbatchReadsThem) {
  EXPECT_EQ(time_limit_s("90"), 5400);
  EXPECT_EQ(time_limit_s("1:30"), 90);
  EXPECT_EQ(time_limit_s("12:00:30"), 43230);
  EXPECT_EQ(time_limit_s("2-12"), 216000);
  EXPECT_EQ(time_limit_s("1-0:30"), 88200);
  EXPECT_EQ(time_limit_s("1-00:00:01"), 86401);
  for (const char* text : {"", "-", "1-", "a", "1:2:3:4", "-5", "1:", "99999999999999999999"})
    EXPECT_FALSE(time_limit_s(text).has_value()) << text;
}

SlurmJob small_job() {
  SlurmJob job;
  job.name = "my runs";
  job.program = "/opt/it's/sluice";
  job.campaign = "/home/a/c.toml";
  job.out = "/home/a/100% out";
  job.working_directory = "/home/a";
  job.runs = {"one", "two"};
  job.memory_bytes = 2'000'000'000;
  job.options.threads = 4;
  return job;
}

TEST(Slurm, TheRunsAreAnArray) {
  SlurmJob job = small_job();
  const std::string plain = slurm_runs_script(job);
  EXPECT_THAT(plain, testing::StartsWith("#!/bin/bash\n#SBATCH --job-name=sluice-my-runs\n"));
  EXPECT_THAT(plain, AllOf(HasSubstr("#SBATCH --array=1-2\n"), HasSubstr("#SBATCH --cpus-per-task=4\n"),
                           HasSubstr("#SBATCH --mem=3200M\n"), HasSubstr("#SBATCH --requeue --signal=B:USR1@120\n"),
                           HasSubstr("#SBATCH --output=\"/home/a/100%% out/slurm/%A_%a.log\"\n"),
                           HasSubstr("'/opt/it'\\''s/sluice' campaign '/home/a/c.toml' --out '/home/a/100% out' "
                                     "--threads 4 --checkpoint-every 600 --only \"$run\"")));
  EXPECT_THAT(plain, AllOf(Not(HasSubstr("--partition")), Not(HasSubstr("--time="))));
  job.options.partition = "compute";
  job.options.time_limit = "12:00:00";
  job.options.at_once = 3;
  job.options.options = {"--account=hydro"};
  EXPECT_THAT(slurm_runs_script(job),
              AllOf(HasSubstr("#SBATCH --partition=compute\n#SBATCH --time=12:00:00\n"),
                    HasSubstr("#SBATCH --array=1-2%3\n"), HasSubstr("#SBATCH --account=hydro\n")));
}

TEST(Slurm, TheReportIsAJobOfItsOwn) {
  const std::string script = slurm_report_script(small_job());
  EXPECT_THAT(script, AllOf(HasSubstr("--job-name=sluice-my-runs-report\n"), HasSubstr("--cpus-per-task=1\n"),
                            testing::EndsWith(" --report-only\n"), Not(HasSubstr("--array")), Not(HasSubstr("USR1"))));
}

TEST(Slurm, PathsThatNoDirectiveCanHoldAreRefused) {
  SlurmJob job = small_job();
  EXPECT_NO_THROW(refuse_odd_paths(job));
  job.out = "/home/\"a\"";
  EXPECT_THROW(refuse_odd_paths(job), std::runtime_error);
}

/// A task's script, run by a shell with stand-ins for the program and for scontrol.
class SlurmTask : public testing::Test {
 protected:
  SlurmTask() : directory(fs::temp_directory_path() / fmt::format("sluice-task-{}", name())) {
    fs::remove_all(directory);
    fs::create_directories(directory);
    put("scontrol", "#!/bin/bash\necho \"$*\" >>" + (directory / "requeued").string() + "\nkill $PPID\n");
  }
  ~SlurmTask() override { fs::remove_all(directory); }

  static std::string name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
  void put(const std::string& file, const std::string& text) const {
    std::ofstream(directory / file) << text;
    fs::permissions(directory / file, fs::perms::owner_all);
  }
  std::string text(const std::string& file) const {
    std::ostringstream all;
    all << std::ifstream(directory / file).rdbuf();
    return all.str();
  }
  /// The exit code of task 2; `meanwhile` is shell code that may use $task, its process.
  int run(const std::string& program, const std::string& meanwhile) const {
    put("program", "#!/bin/bash\n" + program);
    SlurmJob job = small_job();
    job.program = directory / "program";
    put("task.sh", slurm_runs_script(job));
    put("test.sh", fmt::format("cd {}\nPATH=.:$PATH SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_JOB_ID=77 SLURM_JOB_ID=77 bash "
                               "task.sh >task.log 2>&1 &\n"
                               "task=$!\n{}\nwait $task\n",
                               directory.string(), meanwhile));
    const int status = std::system(fmt::format("bash {}/test.sh", directory.string()).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  fs::path directory;
};

constexpr const char* patient = R"(echo "$*" >arguments
stop() { echo once >>stopped; sleep 0.3; exit 143; }
trap stop TERM
touch ready
for i in $(seq 100); do sleep 0.05; done
)";
constexpr const char* once_ready = "until [ -e ready ]; do sleep 0.05; done\n";

TEST_F(SlurmTask, ComputesItsRunAndPassesItsExitCodeOn) {
  EXPECT_EQ(run("echo \"$*\" >arguments; exit 3", ":"), 3);
  EXPECT_THAT(text("arguments"), testing::EndsWith("--only two\n"));
  EXPECT_FALSE(fs::exists(directory / "requeued"));
}

TEST_F(SlurmTask, OutOfTimeGoesBackIntoTheQueueWithACheckpoint) {
  run(patient, std::string(once_ready) + "kill -USR1 $task");
  EXPECT_EQ(text("stopped"), "once\n");
  EXPECT_EQ(text("requeued"), "requeue 77_2\n");
}

TEST_F(SlurmTask, CancelledIsNotPutBackAndStopsTheProgramOnce) {
  EXPECT_EQ(run(patient, std::string(once_ready) + "kill $task; pkill -TERM -P $task"), 143);
  EXPECT_EQ(text("stopped"), "once\n");
  EXPECT_FALSE(fs::exists(directory / "requeued"));
}

TEST_F(SlurmTask, ARunThatFailsAtTheLimitIsNotPutBack) {
  EXPECT_EQ(run("trap \"exit 1\" TERM; touch ready; for i in $(seq 100); do sleep 0.05; done",
                std::string(once_ready) + "kill -USR1 $task"),
            1);
  EXPECT_FALSE(fs::exists(directory / "requeued"));
}

}  // namespace
}  // namespace sluice
