#include "ci/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "validation/printable.h"

namespace sluice::ci {
namespace {

/// Findings that began with one commit in one kind of run belong together.
struct Group {
  std::vector<std::pair<const SeriesFindings*, const Finding*>> findings;
};
using GroupKey = std::tuple<std::string, std::string, std::string>;  // date, commit, kind of run

std::string day(const Result& result) {
  return result.date.substr(0, 10);
}

/// What else is new with the first result at the new level.
std::string other_changes(const Result& before, const Result& first) {
  std::string text;
  const auto note = [&](const char* what, const std::string& from, const std::string& to) {
    if (from != to) text += fmt::format("  also new there: {}, `{}` before, `{}` now\n", what, from, to);
  };
  note("machine", before.machine, first.machine);
  note("compiler", before.compiler, first.compiler);
  note("flags", before.flags, first.flags);
  if (before.inputs != first.inputs) text += "  also new there: the case file or the measured data\n";
  if (before.commit == first.commit) text += "  the commit is the same before and after: not a change of the code\n";
  return text;
}

std::string group_text(const GroupKey& key, const Group& group) {
  const Finding& any = *group.findings.front().second;
  const auto& [date, commit, run_kind] = key;
  std::string text = fmt::format("{}\n  since {} ({}); last good {} ({})\n", run_kind, commit, date.substr(0, 10),
                                 any.last_before->commit, day(*any.last_before));
  for (const auto& [found, finding] : group.findings) text += fmt::format("  {}\n", finding_text(*found, *finding));
  text += other_changes(*any.last_before, *any.first);
  text += fmt::format("  runs: before {}, after {}\n", any.last_before->link, any.first->link);
  return text;
}

bool is_shown(const Finding& finding, bool everything) {
  return everything || finding.state == State::open;
}

std::string headline(const std::vector<SeriesFindings>& all, const Count& n) {
  std::string newest;
  for (const SeriesFindings& found : all) newest = std::max(newest, found.series.points.back()->date);
  return fmt::format("{} in {} series{}; {} accepted, {} fixed, {} better\n",
                     n.open == 0 ? "no open regression" : fmt::format("{} open regressions", n.open), n.series,
                     newest.empty() ? "" : ", last run " + newest, n.accepted, n.fixed, n.better);
}

std::string stale_text(const std::vector<SeriesFindings>& all) {
  std::map<std::string, std::string> kinds;  // of run, with the last date
  for (const SeriesFindings& found : all)
    if (found.stale) {
      std::string& last = kinds[found.series.key.run_kind()];
      last = std::max(last, found.series.points.back()->date.substr(0, 10));
    }
  std::string text;
  for (const auto& [kind, last] : kinds)
    text += fmt::format("not seen since {}: {} (some or all of its metrics)\n", last, kind);
  return text;
}

}  // namespace

Count count(const std::vector<SeriesFindings>& all) {
  Count n;
  n.series = all.size();
  for (const SeriesFindings& found : all) {
    n.stale += found.stale;
    for (const Finding& finding : found.findings) {
      n.open += finding.state == State::open;
      n.accepted += finding.state == State::accepted;
      n.fixed += finding.state == State::fixed;
      n.better += finding.verdict == Verdict::better;
    }
  }
  return n;
}

std::string detail_text(const SeriesFindings& found, const Finding& finding) {
  const MetricSeries& series = found.series;
  const Shift& shift = finding.shift;
  std::string text;
  if (finding.verdict == Verdict::missing) {
    text = finding.first->reason;
  } else {
    const double needed = shift.before + std::copysign(shift.threshold, shift.after - shift.before);
    text = fmt::format("{}; {} needed", change_text(series, shift.before, shift.after),
                       change_text(series, shift.before, needed));
    if (shift.scatter > 0)
      text += fmt::format(", {:.1f} times the scatter", std::abs(shift.after - shift.before) / shift.scatter);
  }
  if (finding.acceptance == nullptr) return text;
  const std::string by = finding.acceptance->by.empty() ? "" : " by " + finding.acceptance->by;
  return text + fmt::format("; accepted{}: {}", by, finding.acceptance->reason);
}

std::string finding_text(const SeriesFindings& found, const Finding& finding) {
  const MetricSeries& series = found.series;
  const std::string now = finding.verdict == Verdict::missing ? "no value" : value_text(series, finding.shift.after);
  return fmt::format("{:<8} {}: {} to {} ({}){}  series {}", in_capitals(to_string(finding.verdict)),
                     series.key.quantity(), value_text(series, finding.shift.before), now, detail_text(found, finding),
                     finding.state == State::open ? "" : fmt::format(" [{}]", to_string(finding.state)),
                     series.key.id());
}

std::string summary(const std::vector<SeriesFindings>& all, bool everything) {
  std::map<GroupKey, Group> groups;
  for (const SeriesFindings& found : all)
    for (const Finding& finding : found.findings)
      if (is_shown(finding, everything))
        groups[{finding.first->date, finding.first->commit, found.series.key.run_kind()}].findings.emplace_back(
            &found, &finding);
  const Count n = count(all);
  std::string text = "ledger check: " + headline(all, n);
  for (const auto& [key, group] : groups) text += fmt::format("\n{}", group_text(key, group));
  if (const std::string stale = stale_text(all); !stale.empty()) text += fmt::format("\n{}", stale);
  if (n.open > 0)
    text +=
        "\nMend it, or put it on record: ledger accept --series ID --reason \"why\" (also --commit, --all; see "
        "--help)\n";
  return text;
}

}  // namespace sluice::ci
