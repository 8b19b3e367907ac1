// What the methods cost against each other.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {
namespace {

std::optional<double> seconds_per_second(const AnalysedRun& run) {
  const auto cost_s = processor_time_s(run);
  const auto time_s = run.record.number("time_s");
  if (!cost_s || !time_s || *time_s <= 0) return std::nullopt;
  return *cost_s / *time_s;
}

void add_pair(Table& table, TableCell mps, TableCell wcsph, double l0_m, std::optional<double> mps_s,
              std::optional<double> wcsph_s, bool comparable = true) {
  const auto ratio = comparable && mps_s && wcsph_s ? std::optional(*mps_s / *wcsph_s) : std::nullopt;
  table.add({std::move(mps), std::move(wcsph), typed(l0_m), rounded(mps_s, 3), rounded(wcsph_s, 3), rounded(ratio, 3)});
}

/// One row a particle distance that is printed for both methods. True if there is any.
bool add_published_pairs(Table& table, const std::vector<PublishedRun>& runs) {
  bool any = false;
  for (const PublishedRun& mps : runs)
    for (const PublishedRun& wcsph : runs) {
      if (mps.solver != "mps" || wcsph.solver != "wcsph" || std::abs(mps.l0_m - wcsph.l0_m) > 1e-9) continue;
      add_pair(table, word("Paper: MPS, as printed"), word("Paper: WCSPH, as printed"), mps.l0_m,
               mps.cpu_time_s / mps.t_end_s, wcsph.cpu_time_s / wcsph.t_end_s);
      any = true;
    }
  return any;
}

}  // namespace

Table cost_ratio_table(const ReportData& data) {
  Table table;
  table.name = "cost_ratio";
  table.caption = "Processor time per simulated second: MPS against WCSPH in one flow at equal particle distance";
  table.columns = {{"MPS run", "mps_run", false}, {"WCSPH run", "wcsph_run", false}, {"l0 [m]", "l0_m"},
                   {"MPS [s/s]", "mps_s_per_s"},  {"WCSPH [s/s]", "wcsph_s_per_s"},  {"MPS / WCSPH", "ratio"}};
  bool threads_differ = false;
  bool machines_differ = false;
  for (const AnalysedRun& m : data.runs) {
    if (m.record.solver != "mps" || ended_early(data, m)) continue;
    for (const AnalysedRun& w : data.runs) {
      if (w.record.solver != "wcsph" || ended_early(data, w) || !same_flow(data, m.record, w.record)) continue;
      const bool one_machine = machine_of(m) && machine_of(m) == machine_of(w);
      machines_differ = machines_differ || !one_machine;
      threads_differ = threads_differ || m.record.number("threads") != w.record.number("threads");
      add_pair(table, word(m.label), word(w.label), m.record.l0_m, seconds_per_second(m), seconds_per_second(w),
               one_machine);
    }
  }
  if (table.rows.empty()) return table;
  if (add_published_pairs(table, data.the_case.published.runs))
    table.notes.push_back(
        "The paper's times are its printed ones over its simulated time; whether they are the clock's or summed over "
        "cores it does not say. The ratio is the same either way.");
  table.notes.push_back(
      "Processor time is summed over threads. Runs that did not share a machine at the same time compare only roughly; "
      "bench/ times whole steps of both solvers side by side.");
  if (const std::string note = left_out_note(data); !note.empty()) table.notes.push_back(note);
  if (machines_differ)
    table.notes.push_back(
        "No ratio where the two runs are of different machines, where one was computed on several, or does not state "
        "its machine.");
  if (threads_differ) table.notes.push_back("Some of these pairs ran on different numbers of threads.");
  return table;
}

}  // namespace sluice
