// The paper's statements, evaluated on the runs at hand.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/conclusions.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {
namespace {

using conclusions::BothMethods;
using conclusions::Evidence;
using conclusions::least;
using conclusions::Verdict;

std::optional<double> per_simulated_second(const AnalysedRun& run, std::optional<double> value) {
  const auto time_s = run.record.number("time_s");
  return value && time_s && *time_s > 0 ? std::optional(*value / *time_s) : std::nullopt;
}

/// A ratio of the paper's MPS to its WCSPH (or the other way round) at each particle distance that it prints for both.
struct PrintedRatios {
  std::string words;
  double at_finest = 0;
  std::map<double, double> at;  ///< by particle distance [m]

  /// The one that runs at a particle distance are held against: where the paper prints none, that of its finest.
  double near(double l0_m) const {
    const auto found =
        std::find_if(at.begin(), at.end(), [&](const auto& a) { return std::abs(a.first - l0_m) < 1e-9; });
    return found != at.end() ? found->second : at_finest;
  }
};

template <class Ratio>
PrintedRatios printed_ratios(const ReportData& data, int decimals, Ratio ratio) {
  PrintedRatios out;
  double finest_m = HUGE_VAL;
  std::size_t count = 0;
  const std::vector<PublishedRun>& runs = data.the_case.published.runs;
  for (const PublishedRun& mps : runs)
    for (const PublishedRun& wcsph : runs) {
      if (mps.solver != "mps" || wcsph.solver != "wcsph" || std::abs(mps.l0_m - wcsph.l0_m) > 1e-9) continue;
      const double value = ratio(mps, wcsph);
      out.at[mps.l0_m] = value;
      out.words +=
          fmt::format("{}{} times at l0 = {:g} mm", count++ > 0 ? ", " : "", fixed(value, decimals), 1000 * mps.l0_m);
      if (mps.l0_m >= finest_m) continue;
      finest_m = mps.l0_m;
      out.at_finest = value;
    }
  if (count == 1) out.words = fmt::format("{} times", fixed(out.at_finest, decimals));
  return out;
}

/// Runs of one machine: the cheapest of each method there, where both ran; of several machines the one with the
/// cheapest run of MPS. Nothing where no machine is known to have both.
struct CostPair {
  const AnalysedRun* mps = nullptr;
  const AnalysedRun* wcsph = nullptr;
  double ratio = 0;
};

std::optional<double> cost_of(const AnalysedRun& run) {
  return per_simulated_second(run, processor_time_s(run));
}

CostPair cheapest_of_one_machine(const BothMethods& both) {
  CostPair best;
  double least_cost = HUGE_VAL;
  for (const AnalysedRun* mps : both.mps) {
    const auto mps_cost = cost_of(*mps);
    const auto machine = machine_of(*mps);
    if (!machine || !mps_cost || *mps_cost >= least_cost) continue;
    std::vector<const AnalysedRun*> beside;
    for (const AnalysedRun* run : both.wcsph)
      if (machine_of(*run) == machine) beside.push_back(run);
    const auto [wcsph_cost, wcsph] = least(beside, cost_of);
    if (!wcsph_cost) continue;
    least_cost = *mps_cost;
    best = {mps, wcsph, *mps_cost / *wcsph_cost};
  }
  return best;
}

void add_cost(Table& table, const ReportData& data, const BothMethods& both) {
  const PrintedRatios printed =
      printed_ratios(data, 2, [](const auto& mps, const auto& wcsph) { return mps.cpu_time_s / wcsph.cpu_time_s; });
  if (printed.words.empty()) return;
  Evidence ours;
  if (const CostPair pair = cheapest_of_one_machine(both); pair.mps != nullptr) {
    ours.words = fmt::format("{} times, {} to {}", fixed(pair.ratio, 2), pair.mps->key, pair.wcsph->key);
    ours.verdict =
        std::abs(pair.ratio / printed.near(both.l0_m) - 1) < 0.10 ? Verdict::agrees : Verdict::does_not_agree;
  }
  conclusions::add(table, fmt::format("MPS costs {} times WCSPH", fixed(printed.near(both.l0_m), 2)), printed.words,
                   ours);
}

void add_steps(Table& table, const ReportData& data, const BothMethods& both) {
  const PrintedRatios printed =
      printed_ratios(data, 1, [](const auto& mps, const auto& wcsph) { return mps.dt_s / wcsph.dt_s; });
  if (printed.words.empty()) return;
  Evidence ours;
  const auto steps_of = [](const AnalysedRun& run) { return per_simulated_second(run, run.record.number("steps")); };
  const auto [mps_steps, few] = least(both.mps, steps_of);
  const auto [wcsph_steps, many] = least(both.wcsph, steps_of);
  if (mps_steps && wcsph_steps) {
    const double ratio = *wcsph_steps / *mps_steps;
    ours.words = fmt::format("{} times, {} to {}", fixed(ratio, 1), many->key, few->key);
    ours.verdict = ratio > 0.75 * printed.near(both.l0_m) ? Verdict::agrees : Verdict::does_not_agree;
  }
  conclusions::add(table, "WCSPH takes many more steps than MPS", printed.words, ours);
}

}  // namespace

Table conclusions_table(const ReportData& data) {
  Table table;
  table.name = "conclusions";
  table.caption = "Statements of the paper on this case, its evidence, and what these runs say";
  table.columns = {{"Statement", "statement", false},
                   {"The paper's evidence", "paper", false},
                   {"These runs", "runs", false},
                   {"Verdict", "verdict", false}};
  if (!data.the_case.published.impulses.empty()) {
    conclusions::add_accuracy(table, data);
    conclusions::add_sign(table, data);
    conclusions::add_alpha(table, data);
    table.notes.push_back("Errors: mean unsigned deviation of the impulses, primary readings.");
  }
  conclusions::add_wave_heights(table, data);
  conclusions::add_pressure_oscillations(table, data);
  conclusions::add_force_statements(table, data);
  const BothMethods both = conclusions::finest_of_both(data);
  add_cost(table, data, both);
  add_steps(table, data, both);
  if (data.has(SensorKind::force))
    table.notes.push_back(
        "Oscillations: noise, the root mean square of what a 20 ms running mean takes away. Forces are primary "
        "readings.");
  table.notes.push_back(
      "Where both methods are compared, at the finest particle distance that has both (of runs that reach the window's "
      "end, if any do). Costs: processor time per simulated second, of runs that one machine computed from beginning "
      "to end; they agree within a tenth of what the paper prints for that particle distance or, where it prints none, "
      "for its finest. WCSPH takes many more steps where it takes three quarters of what is printed, or more. Of "
      "errors and oscillations less than a tenth tells no difference, since runs that differ in rounding alone scatter "
      "by some per cent. Of two sides of an alpha one is better where its largest error is by a tenth less than the "
      "other's smallest; where they overlap or lie nearer no difference is told.");
  conclusions::note_judged_parameters(table, data);
  if (std::any_of(data.runs.begin(), data.runs.end(), [](const AnalysedRun& run) { return !run.record.own; }))
    table.notes.push_back(
        "Both methods are compared by runs of the solvers here; runs of other codes are heard on alpha alone.");
  if (conclusions::alpha_scopes(data).size() > 1)
    table.notes.push_back(
        "A row that names walls is judged by the WCSPH runs with these walls alone; costs and steps by the least of "
        "the judged runs of all walls.");
  return table;
}

}  // namespace sluice
