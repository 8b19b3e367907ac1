#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ci/cli/commands.h"
#include "ci/cli/ledger_file.h"
#include "ci/summary.h"
#include "validation/cli/usage_error.h"
#include "validation/manifest.h"

namespace sluice::ci::cli {
namespace {

struct AcceptArguments {
  std::string ledger = default_ledger;
  std::vector<std::string> series;
  std::string commit;
  std::string case_name;
  std::string solver;
  std::string metric;
  bool all = false;
  std::string reason;
  std::string by;
  bool scatter = false;
  bool dry_run = false;
};

bool selects_nothing(const AcceptArguments& a) {
  return !a.all && a.series.empty() && a.commit.empty() && a.case_name.empty() && a.solver.empty() && a.metric.empty();
}

bool is_selected(const AcceptArguments& a, const SeriesFindings& found, const Finding& finding) {
  const SeriesKey& key = found.series.key;
  const auto agrees = [](const std::string& wanted, const std::string& has) { return wanted.empty() || wanted == has; };
  return finding.state == State::open && finding.first->commit.starts_with(a.commit) &&
         agrees(a.case_name, key.case_name) && agrees(a.solver, key.solver) && agrees(a.metric, key.metric) &&
         (a.series.empty() || std::find(a.series.begin(), a.series.end(), key.id()) != a.series.end());
}

Acceptance acceptance_of(const AcceptArguments& a, const SeriesFindings& found, const Finding& finding) {
  const bool shifted = finding.verdict != Verdict::missing;
  return {utc_now(),
          a.by,
          found.series.key.id(),
          finding.first->date,
          finding.first->commit,
          shifted ? finding.shift.after - finding.shift.before : 0,
          a.reason,
          a.scatter && shifted};
}

int accept(const AcceptArguments& arguments) {
  if (selects_nothing(arguments))
    throw sluice::cli::UsageError("say what to accept: --series, --commit, --case, --solver, --metric, or --all");
  if (arguments.reason.find_first_not_of(" \t") == std::string::npos)
    throw sluice::cli::UsageError("--reason: says nothing (those who come later need it)");
  const Ledger ledger = open_ledger(arguments.ledger);
  std::vector<Acceptance> acceptances;
  for (const SeriesFindings& found : find_all(ledger))
    for (const Finding& finding : found.findings)
      if (is_selected(arguments, found, finding)) {
        fmt::print("{}: {}\n", found.series.key.run_kind(), finding_text(found, finding));
        acceptances.push_back(acceptance_of(arguments, found, finding));
      }
  if (acceptances.empty())
    throw std::runtime_error("no open regression fits that (ledger check lists those that there are)");
  if (!arguments.dry_run) append_acceptances(arguments.ledger, acceptances);
  fmt::print("ledger accept: {} {}\n", acceptances.size(), arguments.dry_run ? "would be accepted" : "accepted");
  return 0;
}

}  // namespace

void add_accept(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("accept", "Put open regressions on record as known, with the reason");
  auto arguments = std::make_shared<AcceptArguments>();
  if (const char* user = std::getenv("USER"); user != nullptr) arguments->by = user;
  add_ledger_option(*command, arguments->ledger);
  command->add_option("--series", arguments->series, "Of these series (the ids that check prints)");
  command->add_option("--commit", arguments->commit, "Since this commit (its first digits suffice)");
  command->add_option("--case", arguments->case_name, "Of this case");
  command->add_option("--solver", arguments->solver, "Of this solver");
  command->add_option("--metric", arguments->metric, "Of this metric");
  command->add_flag("--all", arguments->all, "All that are open");
  command->add_option("--reason", arguments->reason, "Why it is accepted")->required();
  command->add_option("--by", arguments->by, "Who accepts it")->capture_default_str();
  command->add_flag("--scatter", arguments->scatter,
                    "The shift means nothing (rounding in another order): from now on, only larger ones are told");
  command->add_flag("--dry-run", arguments->dry_run, "Only say what would be accepted");
  command->footer(
      "Filters narrow each other. The new level is the base that later nights are compared with.\n"
      "Examples:\n"
      "  ledger accept --series 1f3a9c04 --reason \"finer sensor, peaks are sharper\"\n"
      "  ledger accept --commit 8a6d01 --scatter --reason \"sums in another order\"");
  command->callback([arguments, &exit_code] { exit_code = accept(*arguments); });
}

}  // namespace sluice::ci::cli
