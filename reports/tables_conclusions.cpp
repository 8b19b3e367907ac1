// The paper's statements, evaluated on the runs at hand.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {
namespace {

/// What our runs say to a statement; no words: nothing can be said.
struct Evidence {
  std::string words;
  bool agrees = false;
};

void add(Table& table, const std::string& statement, const std::string& paper, const Evidence& ours) {
  const TableCell verdict = ours.words.empty() ? missing()
                            : ours.agrees      ? word("agrees", Tone::good)
                                               : word("does not agree", Tone::bad);
  table.add({word(statement), word(paper.empty() ? "missing" : paper),
             ours.words.empty() ? missing() : word(ours.words), verdict});
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> published_alphas(const ReportData& data) {
  const PublishedRun* run = published_run(data.the_case, "wcsph");
  return run == nullptr ? std::vector<double>{} : run->alpha;
}

/// MPS and WCSPH runs of the finest particle distance that has both.
struct BothMethods {
  std::vector<const AnalysedRun*> mps;
  std::vector<const AnalysedRun*> wcsph;
  double l0_m = 0;
};

BothMethods finest_of_both(const ReportData& data) {
  BothMethods finest;
  for (const AnalysedRun& run : data.runs) {
    if (!run.record.own || run.record.solver != "mps") continue;
    BothMethods both;
    both.l0_m = run.record.l0_m;
    for (const AnalysedRun& other : data.runs) {
      if (!other.record.own || std::abs(other.record.l0_m - both.l0_m) > 1e-9) continue;
      if (other.record.solver == "mps") both.mps.push_back(&other);
      if (other.record.solver == "wcsph") both.wcsph.push_back(&other);
    }
    if (!both.wcsph.empty() && (finest.mps.empty() || both.l0_m < finest.l0_m)) finest = both;
  }
  return finest;
}

/// The smallest value of a quantity over some runs, and whose it is.
template <class Measure>
std::pair<std::optional<double>, const AnalysedRun*> least(const std::vector<const AnalysedRun*>& runs,
                                                           Measure measure) {
  std::optional<double> best;
  const AnalysedRun* whose = nullptr;
  for (const AnalysedRun* run : runs) {
    const std::optional<double> value = measure(*run);
    if (!value || (best && *best <= *value)) continue;
    best = value;
    whose = run;
  }
  return {best, whose};
}

void add_accuracy(Table& table, const ReportData& data) {
  std::vector<double> wcsph;
  for (const double alpha : published_alphas(data))
    if (const auto error = published_mean(data, "wcsph", alpha)) wcsph.push_back(*error);
  const auto mps = published_mean(data, "mps", std::nullopt);
  std::string paper;
  if (mps && !wcsph.empty())
    paper = fmt::format("MPS {}, WCSPH {} to {}", percent(*mps), percent(*std::min_element(wcsph.begin(), wcsph.end())),
                        percent(*std::max_element(wcsph.begin(), wcsph.end())));
  Evidence ours;
  const BothMethods both = finest_of_both(data);
  const auto error = [&](const AnalysedRun& run) { return mean_impulse_error(data, run); };
  const auto [best_mps, mps_run] = least(both.mps, error);
  const auto [best_wcsph, wcsph_run] = least(both.wcsph, error);
  if (best_mps && best_wcsph) {
    ours.words = fmt::format("MPS {} ({}), best WCSPH {} ({})", percent(*best_mps), mps_run->key, percent(*best_wcsph),
                             wcsph_run->label);
    ours.agrees = *best_mps < *best_wcsph;
  }
  add(table, "MPS is more accurate in impulse", paper, ours);
}

void add_sign(Table& table, const ReportData& data) {
  int low = 0;
  int all = 0;
  for (const double alpha : published_alphas(data)) {
    for (const std::string& sensor : data.headline_sensors()) {
      const auto deviation = published_deviation(data, sensor, "wcsph", alpha);
      low += deviation && *deviation < 0;
      all += deviation.has_value();
    }
  }
  const std::string paper = all > 0 ? fmt::format("{} of {} impulses too low", low, all) : "";
  Evidence ours;
  int our_low = 0;
  int our_all = 0;
  for (const AnalysedRun& run : data.runs) {
    if (!run.record.own || run.record.solver != "wcsph") continue;
    for (const std::string& sensor : data.headline_sensors()) {
      const SensorReading* reading = run.primary(sensor);
      const auto deviation = reading == nullptr ? std::nullopt : reading->comparison.impulse.deviation();
      our_low += deviation && *deviation < 0;
      our_all += deviation.has_value();
    }
  }
  if (our_all > 0) ours = {fmt::format("{} of {} impulses too low", our_low, our_all), our_low == our_all};
  add(table, "WCSPH underestimates the impulses", paper, ours);
}

/// Mean error at alpha <= 0.001 and above; missing where one side has no run.
struct AlphaSides {
  std::vector<double> small;
  std::vector<double> large;
  void put(double alpha, std::optional<double> error) {
    if (error) (alpha <= 0.001 * (1 + 1e-9) ? small : large).push_back(*error);
  }
  bool both() const { return !small.empty() && !large.empty(); }
  std::string words() const {
    return fmt::format("{} at α ≤ 0.001, {} above", percent(mean(small)), percent(mean(large)));
  }
};

void add_alpha(Table& table, const ReportData& data) {
  AlphaSides printed;
  for (const double alpha : published_alphas(data)) printed.put(alpha, published_mean(data, "wcsph", alpha));
  Evidence ours;
  ours.agrees = true;
  for (const AlphaSeries& series : alpha_series(data)) {
    AlphaSides sides;
    for (const AnalysedRun* run : series.runs) sides.put(*run->record.alpha(), mean_impulse_error(data, *run));
    if (!sides.both()) continue;
    ours.words += fmt::format("{}{}: {}", ours.words.empty() ? "" : "; ", series.title, sides.words());
    ours.agrees = ours.agrees && mean(sides.small) < mean(sides.large);
  }
  add(table, "α ≤ 0.001 gives better impulses", printed.both() ? printed.words() : "", ours);
}

void add_costs(Table& table, const ReportData& data) {
  const PublishedRun* mps = published_run(data.the_case, "mps");
  const PublishedRun* wcsph = published_run(data.the_case, "wcsph");
  std::string cost_words;
  std::string step_words;
  double printed_steps = 0;
  if (mps != nullptr && wcsph != nullptr) {
    cost_words = fmt::format("{} times", fixed(mps->cpu_time_s / wcsph->cpu_time_s, 1));
    printed_steps = mps->dt_s / wcsph->dt_s;
    step_words = fmt::format("{} times", fixed(printed_steps, 1));
  }
  Evidence cost;
  Evidence steps;
  const BothMethods both = finest_of_both(data);
  const auto per_second = [](const AnalysedRun& run, std::optional<double> value) -> std::optional<double> {
    const auto time_s = run.record.number("time_s");
    return value && time_s && *time_s > 0 ? std::optional(*value / *time_s) : std::nullopt;
  };
  const auto cost_of = [&](const AnalysedRun& run) { return per_second(run, processor_time_s(run)); };
  const auto steps_of = [&](const AnalysedRun& run) { return per_second(run, run.record.number("steps")); };
  const auto [mps_cost, costly] = least(both.mps, cost_of);
  const auto [wcsph_cost, cheap] = least(both.wcsph, cost_of);
  if (mps_cost && wcsph_cost) {
    const double ratio = *mps_cost / *wcsph_cost;
    cost = {fmt::format("{} times, {} to {}", fixed(ratio, 2), costly->key, cheap->key), ratio >= 1.75 && ratio < 2.05};
  }
  const auto [mps_steps, few] = least(both.mps, steps_of);
  const auto [wcsph_steps, many] = least(both.wcsph, steps_of);
  if (mps_steps && wcsph_steps) {
    const double ratio = *wcsph_steps / *mps_steps;
    steps = {fmt::format("{} times, {} to {}", fixed(ratio, 1), many->key, few->key),
             std::abs(ratio / printed_steps - 1) < 0.25};
  }
  add(table, "MPS costs 1.8 to 2.0 times WCSPH", cost_words, cost);
  add(table, "WCSPH takes many more steps than MPS", step_words, steps);
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
  add_accuracy(table, data);
  add_sign(table, data);
  add_alpha(table, data);
  add_costs(table, data);
  table.notes.push_back(
      "Errors: mean unsigned deviation of the impulses, primary readings. Where both methods are compared, at the "
      "finest "
      "particle distance that has both. Costs: processor time per simulated second. Steps agree within a quarter.");
  return table;
}

}  // namespace sluice
