#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "validation/checkpoint.h"
#include "validation/cli/commands.h"
#include "validation/progress.h"
#include "validation/run.h"

namespace sluice::cli {
namespace {

struct ResumeArguments {
  std::string directory;
  std::string case_name;
  ResumeOptions options;
};

const char* const resume_footer =
    "Results are those of a run in one go, bit for bit, if program and case are the same; the number of threads may\n"
    "differ. A run writes checkpoints every ten minutes (run --checkpoint-every) and when it is interrupted.\n\n"
    "Example:\n"
    "  sluice resume runs/kleefsman-wcsph-extrapolated-l0.020-alpha0.01";

int resume(ResumeArguments& arguments) {
  if (!arguments.case_name.empty()) arguments.options.the_case = load_case(arguments.case_name);
  arguments.options.progress = stderr;
  arguments.options.terminal = isatty(STDERR_FILENO) == 1;
  const RunOutcome outcome = resume_run(arguments.directory, arguments.options);
  if (!outcome.error.empty())
    throw std::runtime_error(fmt::format("{} (see {}/log.txt)", outcome.error, arguments.directory));
  tell(stderr, fmt::format("{}; results in {}\n", outcome.status, arguments.directory));
  return outcome.exit_code;
}

}  // namespace

void add_resume(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("resume", "Go on with a run that was interrupted or killed");
  auto arguments = std::make_shared<ResumeArguments>();
  command->add_option("DIR", arguments->directory, "Run directory with a checkpoint")->required();
  command->add_option("--case", arguments->case_name,
                      "Case, where its file has moved since (default: the file that the run began with)");
  command->add_option("--threads", arguments->options.threads, "Threads (default: as many as before)")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--checkpoint-every", arguments->options.checkpoint_every_s,
                   "Seconds between checkpoints; 0: only when interrupted")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->footer(resume_footer);
  command->callback([arguments, &exit_code] { exit_code = resume(*arguments); });
}

}  // namespace sluice::cli
