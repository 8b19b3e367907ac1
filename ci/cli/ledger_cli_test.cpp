// The program as its users meet it: exit codes, what goes to which stream, and the way of a regression from the run to
// the alarm, to its acceptance.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "ci/ledger.h"
#include "ci/made_results.h"
#include "reports/synthetic_run.h"
#include "validation/cli/program_test.h"
#include "validation/manifest.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using program_test::Answer;
using program_test::contents;

class LedgerProgram : public program_test::InDirectory {
 protected:
  LedgerProgram() : InDirectory("sluice-ledger-cli"), file(directory / "ledger.jsonl") {}

  Answer ledger(const std::string& arguments) const {
    return command(fmt::format("SLUICE_LEDGER={} USER=tester {} {}", file.string(), program, arguments));
  }

  /// A run of one night whose impulses are `scale` times the measured ones.
  fs::path run(int days, double scale) const {
    const fs::path path = directory / fmt::format("run-{}", days);
    synthetic::write_run(path, {.scale = scale});
    nlohmann::json manifest = nlohmann::json::parse(std::ifstream(path / "run.json"));
    manifest["started"] = made::night(days);
    manifest["commit"] = fmt::format("c{:03}", days);
    manifest["machine"] = "a processor, 2 processors, 8 GiB";
    write_manifest(path, manifest);
    return path;
  }

  std::string program = program_test::program_path("LEDGER_PROGRAM", "ledger");
  fs::path file;
};

TEST_F(LedgerProgram, HelpAndVersionGoToStdout) {
  for (const char* arguments : {"--help", "append --help", "check --help", "accept --help", "dashboard --help"}) {
    const Answer answer = ledger(arguments);
    EXPECT_EQ(answer.exit_code, 0) << arguments;
    EXPECT_THAT(answer.out, HasSubstr("Examples:")) << arguments;
    EXPECT_EQ(answer.err, "") << arguments;
  }
  EXPECT_THAT(ledger("--version").out, StartsWith("ledger "));
}

TEST_F(LedgerProgram, UsageErrorsAreTwo) {
  append_results(file, std::vector{made::result(1, "steps", "", 10)});
  for (const char* arguments : {"", "bogus", "append", "append --date yesterday x", "check --bogus", "accept --all",
                                "accept --reason why", "accept --all --reason ' '"}) {
    const Answer answer = ledger(arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_THAT(answer.err, StartsWith("ledger: error: ")) << arguments;
    EXPECT_EQ(answer.out, "") << arguments;
  }
  EXPECT_THAT(ledger("chek").err, HasSubstr("did you mean `check`?"));
}

TEST_F(LedgerProgram, FailuresAreOne) {
  for (const char* arguments : {"check", "dashboard", "accept --all --reason why", "append no/such/run"}) {
    const Answer answer = ledger(arguments);
    EXPECT_EQ(answer.exit_code, 1) << arguments;
    EXPECT_THAT(answer.err, StartsWith("ledger: error: ")) << arguments;
  }
  EXPECT_THAT(ledger("check --ledger none.jsonl").err, HasSubstr("none.jsonl: no such ledger (make one with"));
}

TEST_F(LedgerProgram, FromTheRunToTheAlarmToItsAcceptance) {
  std::string runs;
  for (int days = 0; days < 6; ++days) runs += fmt::format(" {}", run(days, 1.05).string());
  const Answer first = ledger("append" + runs);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(ledger("check").exit_code, 0);
  EXPECT_THAT(ledger("append" + runs).out, HasSubstr("0 results added"));

  ledger(fmt::format("append --link-base https://example.org/n6 {}", run(6, 1.12).string()));
  const Answer alarm = ledger("check");
  EXPECT_EQ(alarm.exit_code, 1);
  EXPECT_THAT(alarm.out, AllOf(HasSubstr("kleefsman wcsph, alpha 0.01, l0_m 0.02"),
                               HasSubstr("since c006 (2026-01-07); last good c005 (2026-01-06)"),
                               HasSubstr("impulse_deviation of P1 wall: +5.00 % to +12.00 %"),
                               HasSubstr("after https://example.org/n6/run-6")));

  EXPECT_EQ(ledger("accept --commit c005 --reason none").exit_code, 1) << "nothing began with that commit";
  EXPECT_THAT(ledger("accept --commit c006 --metric rmse_over_range --reason why --dry-run").out,
              HasSubstr("would be accepted"));
  EXPECT_EQ(ledger("check").exit_code, 1);
  const Answer accepted = ledger("accept --commit c006 --reason 'a known one'");
  EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
  EXPECT_EQ(ledger("check").exit_code, 0);
  EXPECT_THAT(ledger("check --everything").out, HasSubstr("accepted by tester: a known one) [accepted]"));
  EXPECT_EQ(read_ledger(file).acceptances.front().by, "tester");

  ledger(fmt::format("append {}", run(7, 1.12).string()));
  EXPECT_EQ(ledger("check").exit_code, 0) << "the new level is the base";
  ledger(fmt::format("append {}", run(8, 1.20).string()));
  EXPECT_EQ(ledger("check").exit_code, 1) << "and a further step is told";
}

TEST_F(LedgerProgram, ARunThatCannotBeReadDoesNotKeepTheOthersOut) {
  const Answer answer = ledger(fmt::format("append no/such/run {}", run(0, 1).string()));
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, HasSubstr("no/such/run: left out"));
  EXPECT_FALSE(read_ledger(file).results.empty());
}

TEST_F(LedgerProgram, BenchmarksOfThisBuild) {
  std::ofstream(directory / "bench.json") << R"({"context": {"date": "2026-11-25T14:31:44+00:00"}, "benchmarks": [
          {"name": "wcsph/sort/1000", "run_type": "iteration", "real_time": 2.0, "cpu_time": 2.0, "time_unit": "us"}]})";
  const std::string bench = (directory / "bench.json").string();
  EXPECT_EQ(ledger("append " + bench).exit_code, 1);
  EXPECT_THAT(ledger("append --this-build " + bench).out, HasSubstr("2 results added"));
  const Ledger there = read_ledger(file);
  ASSERT_EQ(there.results.size(), 2u);
  EXPECT_EQ(there.results[0].commit, build_info().commit);
  EXPECT_EQ(there.results[0].machine, machine_fingerprint());
}

TEST_F(LedgerProgram, DamagedLinesAreToldOnStderr) {
  append_results(file, std::vector{made::result(1, "steps", "", 10)});
  std::ofstream(file, std::ios::app) << "half a li\n";
  const Answer answer = ledger("check");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.err, HasSubstr("ledger.jsonl:2: left out: is not JSON"));
}

TEST_F(LedgerProgram, TheDashboardIsOneFile) {
  append_results(file, made::example().results);
  const fs::path page = directory / "site" / "index.html";
  EXPECT_EQ(ledger("dashboard --out " + page.string()).exit_code, 0);
  EXPECT_THAT(contents(page), AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("impulse_deviation of P1 nearest"),
                                    Not(HasSubstr("src=")), Not(HasSubstr("@import")), Not(HasSubstr("url("))));
  EXPECT_EQ(std::distance(fs::directory_iterator(page.parent_path()), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace sluice::ci
