// The program as its users meet it: exit codes, and what goes to which stream.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "validation/cli/program_test.h"
#include "validation/manifest.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using program_test::Answer;
using program_test::contents;

class CommandLine : public program_test::InDirectory {
 protected:
  CommandLine() : InDirectory("sluice-cli") {}

  Answer sluice(const std::string& arguments) const { return command(fmt::format("{} {}", program, arguments)); }
  /// Exit code of a command that is told to end as soon as its run has samples.
  int interrupted(const std::string& arguments, const fs::path& run) const {
    // SIGTERM, since a shell without job control starts programs in the background with SIGINT ignored.
    const int status = std::system(
        fmt::format("bash -c '{} {} >/dev/null 2>{} & pid=$!; while ! grep -qs . {}/probes.csv; do sleep 0.1; done; "
                    "kill -TERM $pid; wait $pid'",
                    program, arguments, told_when_interrupted.string(), run.string())
            .c_str());
    return WEXITSTATUS(status);
  }

  std::string program = program_test::program_path("SLUICE_PROGRAM", "sluice");
  fs::path told_when_interrupted = directory / "interrupted";
};

TEST_F(CommandLine, HelpAndVersionGoToStdout) {
  for (const char* arguments :
       {"--help", "list --help", "run --help", "resume --help", "campaign --help", "compare --help", "validate --help",
        "report --help", "data --help", "data digest --help"}) {
    const Answer answer = sluice(arguments);
    EXPECT_EQ(answer.exit_code, 0) << arguments;
    EXPECT_THAT(answer.out, HasSubstr("Example")) << arguments;
    EXPECT_EQ(answer.err, "") << arguments;
  }
  EXPECT_THAT(sluice("--version").out, StartsWith("sluice "));
}

TEST_F(CommandLine, UsageErrorsAreTwo) {
  for (const char* arguments : {"", "bogus", "run", "run kleefsman --walls glass", "run kleefsman --l0 0.5",
                                "run kleefsman --l0 two", "run kleefsman alhpa=1", "run kleefsman --threads -1",
                                "resume", "campaign", "compare", "validate --tier none", "report", "data"}) {
    const Answer answer = sluice(arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_THAT(answer.err, StartsWith("sluice: error: ")) << arguments;
    EXPECT_EQ(answer.out, "") << arguments;
  }
  EXPECT_THAT(sluice("validat").err, HasSubstr("did you mean `validate`?"));
}

TEST_F(CommandLine, FailuresAreOne) {
  EXPECT_EQ(sluice("run no-such-case").exit_code, 1);
  EXPECT_EQ(sluice("resume " + directory.string()).exit_code, 1);
  EXPECT_EQ(sluice("campaign " + (directory / "no.toml").string()).exit_code, 1);
  EXPECT_EQ(sluice("compare " + (directory / "no.toml").string()).exit_code, 1);
  EXPECT_EQ(sluice("report " + (directory / "nowhere").string()).exit_code, 1);
  const Answer large = sluice("run kleefsman --l0 0.0002 --dry-run");
  EXPECT_EQ(large.exit_code, 1);
  EXPECT_THAT(large.err, AllOf(StartsWith("sluice: error: "), HasSubstr("use --l0")));
}

TEST_F(CommandLine, ListShowsTheCaseAndItsData) {
  EXPECT_THAT(sluice("list").out, AllOf(HasSubstr("kleefsman"), HasSubstr("P1 P2"), HasSubstr("digest.csv (present)")));
}

TEST_F(CommandLine, DryRunWritesNothing) {
  const fs::path run = directory / "run";
  const Answer answer = sluice("run kleefsman --l0 0.05 --dry-run --out " + run.string());
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, HasSubstr("particles: "));
  EXPECT_FALSE(fs::exists(run));
}

TEST_F(CommandLine, ARunLandsInItsDirectory) {
  const fs::path run = directory / "run";
  const std::string command = "run kleefsman --l0 0.05 --threads 1 t_end_s=0.02 --alpha 0.05 --out " + run.string();
  const Answer answer = sluice(command);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const RunRecord record = read_run(run);
  EXPECT_EQ(record.status(), "finished");
  EXPECT_EQ(record.alpha(), 0.05);
  EXPECT_EQ(record.number("t_end_s"), 0.02);
  EXPECT_GE(record.probes.rows(), 20u);
  EXPECT_TRUE(fs::exists(run / "log.txt"));
  EXPECT_THAT(sluice(command).err, HasSubstr("--force"));
  EXPECT_EQ(sluice(command + " --force").exit_code, 0);
}

// The whole path at its cheapest: both wall models, the report, and a verdict. So short a run proves nothing, and
// `validate` must say so instead of passing it.
TEST_F(CommandLine, ValidateOfATooShortRunDoesNotPass) {
  std::string text = contents("validation/cases/kleefsman.toml");
  const std::string quick = "l0_m = 0.03, t_end_s = 6.0";
  ASSERT_NE(text.find(quick), std::string::npos);
  text.replace(text.find(quick), quick.size(), "l0_m = 0.03, t_end_s = 0.005");
  const std::string title = "Dam break against a box";
  text.replace(text.find(title), title.size(), "A case of my own");
  std::ofstream(directory / "short.toml") << text;
  const Answer answer =
      sluice(fmt::format("validate {0}/short.toml --threads 1 --runs {0}/runs --out {0}/report", directory.string()));
  EXPECT_EQ(answer.exit_code, 1) << answer.err;
  EXPECT_THAT(answer.out, AllOf(HasSubstr("impulse_deviation P1 wall"), HasSubstr("missing (the run covers 0.0"),
                                HasSubstr("A BAND COULD NOT BE JUDGED"), HasSubstr("for comparison only")));
  EXPECT_THAT(contents(directory / "report" / "index.html"),
              AllOf(HasSubstr("A case of my own"), Not(HasSubstr("another version of the case file"))))
      << "the report reads the file that the runs were made with";
}

TEST_F(CommandLine, AnInterruptedValidationGoesOnOrKeepsWhatItHad) {
  std::string text = contents("validation/cases/kleefsman.toml");
  const std::string quick = "l0_m = 0.03, t_end_s = 6.0";
  text.replace(text.find(quick), quick.size(), "l0_m = 0.05, t_end_s = 0.5");
  std::ofstream(directory / "short.toml") << text;
  const std::string command = fmt::format(
      "validate {0}/short.toml --solver mps --threads 1 --runs {0}/runs --out {0}/report", directory.string());
  const fs::path run = directory / "runs" / "validate-quick-kleefsman-mps-dummies";
  ASSERT_EQ(interrupted(command, run), 143);
  const bool same_build = names_one_build(read_run(run).text("commit").value_or(""));
  EXPECT_THAT(contents(told_when_interrupted), HasSubstr(same_build ? "the same command goes on with this run"
                                                                    : "the same command begins this run anew"));
  EXPECT_EQ(contents(told_when_interrupted).find("sluice resume ") == std::string::npos, same_build);
  sluice(command);
  EXPECT_EQ(read_run(run).status(), "finished");
  EXPECT_EQ(read_run(run).number("resumed").value_or(0), same_build ? 1 : 0);
  const fs::path outdated = directory / "runs" / "outdated";
  EXPECT_EQ(fs::exists(outdated / run.filename()), !same_build);
  EXPECT_EQ(sluice(command + " --reuse").err.find("reused") != std::string::npos, same_build);
  EXPECT_THAT(sluice(command).err, HasSubstr("finished before: kept as " + (outdated / run.filename()).string()));
}

TEST_F(CommandLine, ARunDoesNotTakeTheFolderOfAnothersSeries) {
  std::ofstream(directory / "probes.csv") << "t_s,P1_Pa\n0,1\n";
  const Answer answer = sluice("run kleefsman --l0 0.05 --threads 1 t_end_s=0.02 --out " + directory.string());
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, HasSubstr("holds a run already"));
  EXPECT_EQ(contents(directory / "probes.csv"), "t_s,P1_Pa\n0,1\n");
}

TEST_F(CommandLine, AnInterruptedRunKeepsItsResults) {
  const fs::path run = directory / "run";
  EXPECT_EQ(interrupted("run kleefsman --l0 0.05 --threads 1 --out " + run.string(), run), 143);
  const RunRecord record = read_run(run);
  EXPECT_EQ(record.status(), "interrupted");
  EXPECT_GT(record.probes.rows(), 0u);
}

// One run that ends, one that cannot: the campaign goes on, tells the failure, and keeps what is finished.
TEST_F(CommandLine, ACampaignGoesOnPastAFailureAndKeepsWhatIsFinished) {
  std::ofstream(directory / "c.toml") << R"(name = "c"
[[runs]]
case = "kleefsman"
solver = "mps"
l0_m = [0.05]
t_end_s = 0.01
parameters = { most_iterations = 1 }
[[runs]]
case = "kleefsman"
solver = "wcsph"
walls = ["dynamic"]
l0_m = [0.05]
t_end_s = 0.01
)";
  const std::string command = fmt::format("campaign {} --threads 1 --no-report --out {}",
                                          (directory / "c.toml").string(), (directory / "runs").string());
  const Answer plan = sluice(command + " --dry-run");
  EXPECT_EQ(plan.exit_code, 0);
  EXPECT_THAT(plan.out, HasSubstr("2 runs, 2 to compute"));
  EXPECT_THAT(sluice(command + " --dry-run --only kleefsman-wcsph-dynamic-l0.050-alpha0.01-t_end_s0.01").out,
              HasSubstr("1 runs, 1 to compute"));
  EXPECT_FALSE(fs::exists(directory / "runs")) << "a dry run computes nothing";
  const Answer first = sluice(command);
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.out, AllOf(HasSubstr("failed       kleefsman-mps"), HasSubstr("did not converge"),
                               HasSubstr("finished     kleefsman-wcsph")));
  EXPECT_THAT(first.out, HasSubstr("planned at its begin"));
  EXPECT_THAT(sluice(command).out, AllOf(HasSubstr("2 runs, 1 to compute"), HasSubstr("kept         kleefsman-wcsph")));
  EXPECT_THAT(contents(directory / "stderr"), HasSubstr("unfinished, and without a checkpoint: kept as "));
}

/// With stand-ins for Slurm's programs; campaign_slurm_test has the real ones.
TEST_F(CommandLine, OneRunOfACampaignIsSubmittedUnlessTheQueueIsUnknown) {
  std::ofstream(directory / "c.toml") << R"(name = "c"
slurm = { threads = 3 }
[[runs]]
case = "kleefsman"
solver = "mps"
l0_m = [0.05, 0.04]
t_end_s = 0.5
)";
  const auto stand_in = [&](const std::string& name, const std::string& words) {
    std::ofstream(directory / name) << "#!/bin/sh\n" << words << "\n";
    fs::permissions(directory / name, fs::perms::owner_all);
  };
  stand_in("sbatch", "echo 7");
  stand_in("squeue", "exit 0");
  program = fmt::format("PATH={}:$PATH {}", directory.string(), program);
  const std::string command =
      fmt::format("campaign {} --engine slurm --only kleefsman-mps-dummies-l0.050-t_end_s0.5 --out {}",
                  (directory / "c.toml").string(), (directory / "runs").string());
  const Answer first = sluice(command);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("job 7: 1 runs"), Not(HasSubstr("report"))));
  EXPECT_FALSE(fs::exists(directory / "runs" / "kleefsman-mps-dummies-l0.050-t_end_s0.5")) << "not computed here";
  EXPECT_THAT(contents(directory / "runs" / "slurm" / "runs.sh"), HasSubstr("--threads 3"));
  stand_in("squeue", "echo cannot reach the controller >&2; exit 1");
  const Answer second = sluice(command);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, AllOf(HasSubstr("as jobs 7: cannot reach the controller"), HasSubstr("try again")));
  stand_in("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  EXPECT_EQ(sluice(command).exit_code, 0) << "forgotten since";
}

TEST_F(CommandLine, AnInterruptedCampaignGoesOnByTheSameCommand) {
  std::ofstream(directory / "c.toml") << R"(name = "c"
[[runs]]
case = "kleefsman"
solver = "mps"
l0_m = [0.05]
t_end_s = 0.5
)";
  const std::string command = fmt::format("campaign {} --threads 1 --no-report --out {}",
                                          (directory / "c.toml").string(), (directory / "runs").string());
  const fs::path run = directory / "runs" / "kleefsman-mps-dummies-l0.050-t_end_s0.5";
  ASSERT_EQ(interrupted(command, run), 143);
  EXPECT_EQ(read_run(run).status(), "interrupted");
  EXPECT_EQ(sluice(command).exit_code, 0);
  EXPECT_EQ(read_run(run).status(), "finished");
  EXPECT_EQ(read_run(run).number("resumed"), 1);
  std::ofstream(directory / "c.toml", std::ios::app) << "snapshots = true\n";
  EXPECT_THAT(sluice(command).err, HasSubstr("outdated (without the snapshots asked for): kept as "));
  EXPECT_EQ(read_run(directory / "runs" / "outdated" / run.filename()).number("resumed"), 1);
  EXPECT_EQ(read_run(run).number("resumed"), 0);
}

}  // namespace
}  // namespace sluice
