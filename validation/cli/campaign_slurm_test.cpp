// The Slurm engine on a real Slurm: a cluster of one node that lives as long as the test (slurm_cluster.sh).
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "validation/checkpoint.h"
#include "validation/cli/program_test.h"
#include "validation/run_directory.h"
#include "validation/run_lock.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using program_test::contents;

bool within(double limit_s, const std::function<bool()>& holds) {
  const auto start = std::chrono::steady_clock::now();
  while (!holds()) {
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > limit_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// A port of this machine that nobody listens on.
class FreePort {
 public:
  FreePort() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (bind(socket_, any, size) == 0 && getsockname(socket_, any, &size) == 0) number = ntohs(address.sin_port);
  }
  ~FreePort() { close(socket_); }
  FreePort(const FreePort&) = delete;
  FreePort& operator=(const FreePort&) = delete;
  int number = 0;

 private:
  int socket_;
};

struct Answer {
  int exit_code = 0;
  std::string text;  ///< standard output and error
};

class OnSlurm : public testing::Test {
 protected:
  OnSlurm() : directory(fs::temp_directory_path() / fmt::format("sluice-slurm-{}", getpid())) {
    fs::create_directories(out);
    fs::permissions(directory, fs::perms(0755));  // munged wants its socket to be within everybody's reach
    setenv("SLURM_CONF", (directory / "slurm.conf").c_str(), 1);
    setenv("OMP_WAIT_POLICY", "passive", 1);  // two threads may share a processor here
    for (const char* name : {"SBATCH_PARTITION", "SBATCH_TIMELIMIT", "SBATCH_SIGNAL"}) unsetenv(name);
    int controller = 0;
    int node = 0;
    {
      const FreePort first;
      const FreePort second;
      controller = first.number;
      node = second.number;
    }
    cluster = popen(
        fmt::format("exec bash validation/cli/slurm_cluster.sh {} {} {}", directory.string(), controller, node).c_str(),
        "we");
  }
  ~OnSlurm() override {
    if (stopped > 0) kill(stopped, SIGCONT);
    pclose(cluster);  // the end of its input is the end of the cluster
    fs::remove_all(directory);
  }

  /// Skips where Slurm is not installed. Where it is, a cluster that does not come up is a failure, whatever stopped it
  /// (slurm_cluster.sh says what it needs); its words must not be those that ctest takes for a skip.
  void SetUp() override {
    const auto is_there = [&](const char* file) { return fs::exists(directory / file); };
    within(100, [&] { return is_there("ready") || is_there("missing") || is_there("problem"); });
    if (is_there("missing")) GTEST_SKIP() << "no Slurm here: " << contents(directory / "missing");
    ASSERT_TRUE(is_there("ready")) << "the cluster is not up: " << contents(directory / "problem");
  }

  Answer command(const std::string& line) const {
    const fs::path log = directory / "answer";
    const int status = std::system(fmt::format("{} >{} 2>&1 </dev/null", line, log.string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(log)};
  }
  Answer sluice(const std::string& arguments) const {
    return command(fmt::format("{} {}", program_test::program_path("SLUICE_PROGRAM", "sluice"), arguments));
  }
  /// The log of a task of the array; `jobs.txt` names the array first, and the report behind a comma.
  fs::path task_log(int task) const { return out / "slurm" / fmt::format("{}_{}.log", array(), task); }
  std::string array() const {
    const std::string jobs = contents(out / "slurm" / "jobs.txt");
    return jobs.substr(0, jobs.find_first_of(",\n"));
  }
  bool queue_is_empty() const {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const Answer answer = command("squeue --noheader");
    return answer.exit_code == 0 && answer.text.empty();
  }
  /// Stops the program that computes a run as soon as it is under way.
  bool stop(const fs::path& run) {
    if (!within(60, [&] { return fs::exists(run / checkpoint_file); })) return false;
    stopped = static_cast<pid_t>(std::atoi(contents(run / lock_file).substr(std::string("process ").size()).c_str()));
    return stopped > 0 && kill(stopped, SIGSTOP) == 0;
  }
  void go_on() {
    kill(stopped, SIGCONT);
    stopped = 0;
  }
  Answer submit_four_runs() const;
  void interrupt_the_last(const fs::path& run);

  fs::path directory;
  fs::path out = directory / "out";
  std::FILE* cluster = nullptr;
  pid_t stopped = 0;
};

/// Two that end, one that fails, and one that is to run out of its time.
Answer OnSlurm::submit_four_runs() const {
  std::ofstream(directory / "tiny.toml") << R"(name = "tiny"
[[runs]]
case = "kleefsman"
solver = "wcsph"
walls = ["dynamic", "extrapolated"]
l0_m = [0.05]
t_end_s = 0.02
[[runs]]
case = "kleefsman"
solver = "mps"
l0_m = [0.05]
t_end_s = 0.01
parameters = { most_iterations = 1 }
[[runs]]
case = "kleefsman"
solver = "wcsph"
l0_m = [0.05]
t_end_s = 0.3
[slurm]
partition = "hydro"
threads = 2
)";
  return sluice(fmt::format("campaign {} --engine slurm --time-limit 3:00 --checkpoint-every 0.05 --out {}",
                            (directory / "tiny.toml").string(), out.string()));
}

// Slurm looks at time limits twice a minute, in which any computer ends such a run. It is therefore held, its limit cut
// to a minute, and let go when the warning has come; then it has its three minutes again.
void OnSlurm::interrupt_the_last(const fs::path& run) {
  ASSERT_TRUE(stop(run)) << contents(task_log(4));
  ASSERT_EQ(read_run(run).status(), "running");
  ASSERT_EQ(command(fmt::format("scontrol update JobId={}_4 TimeLimit=1", array())).exit_code, 0);
  ASSERT_TRUE(within(90, [&] { return contents(task_log(4)).find("told to make room") != std::string::npos; }))
      << contents(task_log(4));
  go_on();
  ASSERT_TRUE(within(60, [&] { return contents(task_log(4)).find("back into the queue") != std::string::npos; }))
      << contents(task_log(4));
  ASSERT_EQ(command(fmt::format("scontrol update JobId={}_4 TimeLimit=3", array())).exit_code, 0);
}

TEST_F(OnSlurm, ACampaignIsComputedRequeuedAndReported) {
  const Answer submitted = submit_four_runs();
  ASSERT_EQ(submitted.exit_code, 0) << submitted.text;
  EXPECT_THAT(submitted.text, AllOf(HasSubstr("4 runs, one a task"), HasSubstr("the report, when they have ended")));
  EXPECT_THAT(command(fmt::format("scontrol show job {}_4", array())).text,
              AllOf(HasSubstr("Partition=hydro"), HasSubstr("TimeLimit=00:03:00"), HasSubstr("CPUs/Task=2"),
                    HasSubstr("Requeue=1")));
  const fs::path late = out / "kleefsman-wcsph-extrapolated-l0.050-alpha0.01-t_end_s0.3";
  const fs::path broken = out / "kleefsman-mps-dummies-l0.050-t_end_s0.01-most_iterations1";
  ASSERT_NO_FATAL_FAILURE(interrupt_the_last(late));
  const Answer again = submit_four_runs();
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.text, HasSubstr("in the queue already"));
  ASSERT_TRUE(within(120, [&] { return queue_is_empty(); })) << command("scontrol show job").text;

  // The one that was put back, as in one go; the one that failed, once and not again.
  EXPECT_THAT(contents(task_log(4)), AllOf(HasSubstr("out of time, back into the queue"), HasSubstr("resumed: ")));
  EXPECT_EQ(read_run(late).status(), "finished");
  EXPECT_EQ(read_run(late).number("resumed"), 1);
  EXPECT_EQ(read_run(late).number("threads"), 2);
  const fs::path whole = directory / "whole";
  ASSERT_EQ(sluice("run kleefsman --l0 0.05 --threads 1 t_end_s=0.3 --out " + whole.string()).exit_code, 0);
  EXPECT_EQ(contents(late / "probes.csv"), contents(whole / "probes.csv"));
  EXPECT_EQ(read_run(broken).status(), "failed");
  const std::string failure = contents(task_log(3));
  EXPECT_THAT(failure, HasSubstr("did not converge"));
  EXPECT_EQ(failure.find("sluice: error"), failure.rfind("sluice: error"));

  // The report has the three, and says which one is missing.
  EXPECT_TRUE(fs::exists(out / "report-kleefsman" / "index.html"));
  const std::string runs = contents(out / "report-kleefsman" / "tables" / "runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 3) << runs;
  const std::string jobs = contents(out / "slurm" / "jobs.txt");
  const std::string report = jobs.substr(jobs.find(',') + 1, jobs.find('\n') - jobs.find(',') - 1);
  EXPECT_THAT(contents(out / "slurm" / fmt::format("report-{}.log", report)),
              AllOf(HasSubstr("to repeat    " + broken.filename().string()), Not(HasSubstr(late.filename().string()))));
  // The same command takes up what is left.
  const std::string rest = sluice(fmt::format("campaign {} --engine slurm --dry-run --out {}",
                                              (directory / "tiny.toml").string(), out.string()))
                               .text;
  EXPECT_THAT(rest, AllOf(HasSubstr("#SBATCH --array=1-1\n"), HasSubstr(broken.filename().string())));
}

}  // namespace
}  // namespace sluice
