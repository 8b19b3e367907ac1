#include "ci/ledger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "ci/made_results.h"
#include "validation/cli/program_test.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using made::result;
using testing::HasSubstr;

using program_test::contents;

class LedgerTest : public testing::Test {
 protected:
  LedgerTest() {
    directory = fs::path(testing::TempDir()) /
                (std::string("sluice-ledger-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory);
    fs::create_directories(directory);
    file = directory / "below" / "ledger.jsonl";
  }
  ~LedgerTest() override { fs::remove_all(directory); }

  fs::path directory;
  fs::path file;
};

TEST_F(LedgerTest, WhatIsWrittenIsRead) {
  Result r = result(3, "impulse_deviation", "P1 wall", -0.1 / 3);
  r.link = "a \"quoted\" link\nof two lines";
  Result none = result(3, "arrival_difference_s", "P1 wall", 0, "s");
  none.value.reset();
  none.reason = "no simulated arrival";
  EXPECT_EQ(append_results(file, std::vector{r, none}).results, 2u);
  append_acceptances(file,
                     std::vector{Acceptance{made::night(4), "me", "12345678", r.date, r.commit, 0.5, "so", true}});
  const Ledger ledger = read_ledger(file);
  EXPECT_TRUE(ledger.damaged.empty());
  ASSERT_EQ(ledger.results.size(), 2u);
  const Result& back = ledger.results[0];
  EXPECT_EQ(back.value, r.value) << "to the last bit";
  EXPECT_EQ(back.date, r.date);
  EXPECT_EQ(back.commit, r.commit);
  EXPECT_EQ(back.machine, r.machine);
  EXPECT_EQ(back.compiler, r.compiler);
  EXPECT_EQ(back.flags, r.flags);
  EXPECT_EQ(back.threads, r.threads);
  EXPECT_EQ(back.inputs, r.inputs);
  EXPECT_EQ(back.case_name, r.case_name);
  EXPECT_EQ(back.solver, r.solver);
  EXPECT_EQ(back.parameters, r.parameters);
  EXPECT_EQ(back.metric, r.metric);
  EXPECT_EQ(back.of, r.of);
  EXPECT_EQ(back.unit, r.unit);
  EXPECT_EQ(back.run, r.run);
  EXPECT_EQ(back.link, r.link);
  EXPECT_FALSE(ledger.results[1].value);
  EXPECT_EQ(ledger.results[1].reason, none.reason);
  ASSERT_EQ(ledger.acceptances.size(), 1u);
  EXPECT_EQ(ledger.acceptances[0].series, "12345678");
  EXPECT_EQ(ledger.acceptances[0].difference, 0.5);
  EXPECT_TRUE(ledger.acceptances[0].scatter);
  EXPECT_THROW(to_line(result(0, "m", "", std::numeric_limits<double>::quiet_NaN())), std::invalid_argument);
}

TEST_F(LedgerTest, ARunIsAddedOnce) {
  const std::vector first{result(1, "steps", "", 10), result(1, "cpu_time_s", "", 2, "s")};
  EXPECT_EQ(append_results(file, first).results, 2u);
  const std::vector again{result(1, "steps", "", 11), result(2, "steps", "", 12)};
  const Appended appended = append_results(file, again);
  EXPECT_EQ(appended.results, 1u);
  EXPECT_EQ(appended.known_runs, 1u);
  EXPECT_EQ(read_ledger(file).results.size(), 3u);
}

TEST_F(LedgerTest, NoFileIsAnEmptyLedger) {
  EXPECT_TRUE(read_ledger(directory / "none").results.empty());
  EXPECT_THROW(read_ledger(directory), std::runtime_error);
}

TEST_F(LedgerTest, DamagedLinesAreNamedAndLeftOut) {
  append_results(file, std::vector{result(1, "steps", "", 10)});
  const std::string good = to_line(result(2, "steps", "", 11));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string line = good;
    line.replace(line.find(from), from.size(), to);
    return line;
  };
  std::ofstream(file, std::ios::app) << "{\"schema\": 1, \"kind\":\n"                             // 2
                                     << "[1, 2]\n"                                                // 3
                                     << changed("\"schema\":1", "\"schema\":2") << '\n'           // 4
                                     << changed("\"value\":11.0", "\"value\":\"11\"") << '\n'     // 5
                                     << changed("\"commit\":\"c002\",", "") << '\n'               // 6
                                     << changed("2026-01-03T", "2026-13-03 ") << '\n'             // 7
                                     << changed("\"kind\":\"result\"", "\"kind\":\"x\"") << '\n'  // 8
                                     << good << '\n'                                              // 9
                                     << good.substr(0, 40);                                       // 10, not ended
  append_results(file, std::vector{result(3, "steps", "", 12)});                                  // 11
  const Ledger ledger = read_ledger(file);
  EXPECT_EQ(ledger.results.size(), 3u);
  std::vector<std::int64_t> lines;
  for (const DamagedLine& damaged : ledger.damaged) lines.push_back(damaged.line);
  EXPECT_EQ(lines, (std::vector<std::int64_t>{2, 3, 4, 5, 6, 7, 8, 10}));
  EXPECT_THAT(ledger.damaged[0].problem, HasSubstr("not JSON"));
  EXPECT_THAT(ledger.damaged[2].problem, HasSubstr("schema 2"));
  EXPECT_THAT(ledger.damaged[3].problem, HasSubstr("value: is not a number"));
  EXPECT_THAT(ledger.damaged[4].problem, HasSubstr("commit: is missing"));
  EXPECT_THAT(ledger.damaged[5].problem, HasSubstr("date: is not a date"));
  EXPECT_THAT(ledger.damaged[6].problem, HasSubstr("unknown kind `x`"));
}

// Eight processes that write at once, each many times: every line is whole, and no run is there twice although all
// write the same ones.
TEST_F(LedgerTest, ManyWritersAtOnce) {
  constexpr int writers = 8, runs = 25, results = 40;
  for (int w = 0; w < writers; ++w) {
    if (fork() != 0) continue;
    for (int run = 0; run < runs; ++run) {
      std::vector<Result> own;
      for (int k = 0; k < results; ++k) own.push_back(result(run, "metric", std::to_string(k), w));
      append_results(file, own);
    }
    _exit(0);
  }
  for (int w = 0; w < writers; ++w) {
    int status = 0;
    wait(&status);
    EXPECT_EQ(status, 0);
  }
  const Ledger ledger = read_ledger(file);
  EXPECT_TRUE(ledger.damaged.empty());
  EXPECT_EQ(ledger.results.size(), static_cast<std::size_t>(runs * results));
  std::set<std::pair<std::string, std::string>> once;
  for (const Result& r : ledger.results) once.emplace(r.run, r.of);
  EXPECT_EQ(once.size(), ledger.results.size());
}

// A file that may not grow further stands for a full disk.
TEST_F(LedgerTest, AFullDiskLeavesTheLedgerAsItWas) {
  append_results(file, std::vector{result(1, "steps", "", 10)});
  const std::string before = contents(file);
  std::vector<Result> many;
  for (int k = 0; k < 50; ++k) many.push_back(result(2, "metric", std::to_string(k), k));
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{before.size() + 1000, before.size() + 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      append_results(file, many);
    } catch (const std::exception& error) {
      _exit(std::string(error.what()).find("as it was") != std::string::npos ? 42 : 43);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(contents(file), before);
}

TEST_F(LedgerTest, AFileThatCannotBeWrittenIsNamed) {
  try {
    append_results("/proc/no/ledger.jsonl", std::vector{result(1, "steps", "", 10)});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/proc/no/ledger.jsonl: cannot be opened"));
  }
}

TEST(LedgerDates, AreUtcToTheSecond) {
  EXPECT_TRUE(is_date("2026-11-25T09:34:08Z"));
  for (const char* wrong : {"", "2026-11-25", "2026-11-25T09:34:08", "2026-13-25T09:34:08Z",
                            "2026-11-25T09:34:08+01:00", "26-11-25T09:34:08Z"})
    EXPECT_FALSE(is_date(wrong)) << wrong;
  EXPECT_DOUBLE_EQ(days_of("1970-01-02T12:00:00Z"), 1.5);
}

}  // namespace
}  // namespace sluice::ci
