// Real runs are killed at random moments and resumed until they end; they must come out as runs in one go. Two programs
// at once in one run directory there cannot be.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "validation/checkpoint.h"
#include "validation/cli/program_test.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

using program_test::contents;

std::string program() {
  return program_test::program_path("SLUICE_PROGRAM", "sluice");
}

pid_t start(const std::vector<std::string>& arguments) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
  const std::string name = program();
  std::vector<char*> argv{const_cast<char*>(name.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  execv(name.c_str(), argv.data());
  _exit(127);
}

/// The exit code, or minus the signal that ended it.
int wait_for(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

class Killed : public testing::TestWithParam<const char*> {
 protected:
  Killed() : directory(fs::temp_directory_path() / fmt::format("sluice-kill-{}", GetParam())) {
    fs::remove_all(directory);
    fs::create_directories(directory);
  }
  ~Killed() override { fs::remove_all(directory); }

  std::vector<std::string> run_arguments(const fs::path& out) const {
    return {"run", "kleefsman",    "--solver",           GetParam(), "--l0",    "0.05",  "--threads",
            "1",   "t_end_s=0.45", "--checkpoint-every", "0.02",     "--force", "--out", out.string()};
  }
  fs::path directory;
};

TEST_P(Killed, RunsComeOutAsInOneGo) {
  constexpr int kills = 30;  // for each of the solvers
  const fs::path whole = directory / "whole";
  const fs::path parts = directory / "parts";
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_EQ(wait_for(start(run_arguments(whole))), 0);
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();

  std::mt19937 random(20);  // moments differ from run to run all the same: the machine's own noise sees to that
  std::uniform_real_distribution<double> moment(0.02 * whole_s, 0.12 * whole_s);
  int killed = 0;
  int resumed = 0;
  for (int attempt = 0; killed < kills; ++attempt) {
    ASSERT_LT(attempt, 10 * kills) << "the run does not come to be killed";
    const bool resumable = fs::exists(parts / checkpoint_file);
    const pid_t pid =
        start(resumable ? std::vector<std::string>{"resume", parts.string(), "--threads", attempt % 2 == 0 ? "1" : "2",
                                                   "--checkpoint-every", "0.02"}
                        : run_arguments(parts));
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    kill(pid, SIGKILL);
    const int code = wait_for(pid);
    resumed += resumable;
    if (code == -SIGKILL) {
      ++killed;
      continue;
    }
    // It was faster than its killer: that is one comparison more, and the next one starts from nothing.
    ASSERT_EQ(code, 0);
    ASSERT_EQ(contents(parts / "probes.csv"), contents(whole / "probes.csv"));
    fs::remove_all(parts);
  }
  if (fs::exists(parts / checkpoint_file)) {
    ASSERT_EQ(wait_for(start({"resume", parts.string()})), 0);
  } else {
    ASSERT_EQ(wait_for(start(run_arguments(parts))), 0);
  }
  EXPECT_GT(resumed, kills / 3);
  EXPECT_EQ(contents(parts / "probes.csv"), contents(whole / "probes.csv"));
  EXPECT_EQ(read_run(parts).number("steps"), read_run(whole).number("steps"));
}

TEST_P(Killed, NoSecondProgramComesInUntilTheFirstIsDead) {
  const fs::path out = directory / "shared";
  const pid_t first = start(run_arguments(out));
  while (!fs::exists(out / checkpoint_file)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(kill(first, SIGSTOP), 0);  // it cannot end meanwhile
  const std::string manifest = contents(out / "run.json");
  EXPECT_EQ(wait_for(start({"resume", out.string()})), 1);
  EXPECT_EQ(wait_for(start(run_arguments(out))), 1) << "even by force";
  EXPECT_EQ(contents(out / "run.json"), manifest);
  kill(first, SIGKILL);
  ASSERT_EQ(wait_for(first), -SIGKILL);
  EXPECT_EQ(wait_for(start({"resume", out.string()})), 0) << "death lets go of the lock";
}

INSTANTIATE_TEST_SUITE_P(Solvers, Killed, testing::Values("wcsph", "mps"));

}  // namespace
}  // namespace sluice
