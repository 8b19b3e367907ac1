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
  bool lacks_measurement = false;  ///< the statement needs one that nobody supplied
};

TableCell verdict(const Evidence& ours) {
  if (ours.lacks_measurement) return word("no measurement", Tone::missing);
  if (ours.words.empty()) return missing();
  return ours.agrees ? word("agrees", Tone::good) : word("does not agree", Tone::bad);
}

void add(Table& table, const std::string& statement, const std::string& paper, const Evidence& ours) {
  table.add({word(statement), word(paper.empty() ? "missing" : paper),
             ours.words.empty() ? missing() : word(ours.words), verdict(ours)});
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

std::optional<double> per_simulated_second(const AnalysedRun& run, std::optional<double> value) {
  const auto time_s = run.record.number("time_s");
  return value && time_s && *time_s > 0 ? std::optional(*value / *time_s) : std::nullopt;
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

/// A ratio of the paper's MPS to its WCSPH (or the other way round) at each particle distance that it prints for both.
struct PrintedRatios {
  std::string words;
  double at_finest = 0;
};

template <class Ratio>
PrintedRatios printed_ratios(const ReportData& data, Ratio ratio) {
  PrintedRatios out;
  double finest_m = HUGE_VAL;
  std::size_t count = 0;
  const std::vector<PublishedRun>& runs = data.the_case.published.runs;
  for (const PublishedRun& mps : runs)
    for (const PublishedRun& wcsph : runs) {
      if (mps.solver != "mps" || wcsph.solver != "wcsph" || std::abs(mps.l0_m - wcsph.l0_m) > 1e-9) continue;
      const double value = ratio(mps, wcsph);
      out.words += fmt::format("{}{} times at l0 = {:g} mm", count++ > 0 ? ", " : "", fixed(value, 1), 1000 * mps.l0_m);
      if (mps.l0_m >= finest_m) continue;
      finest_m = mps.l0_m;
      out.at_finest = value;
    }
  if (count == 1) out.words = fmt::format("{} times", fixed(out.at_finest, 1));
  return out;
}

void add_cost(Table& table, const ReportData& data, const BothMethods& both) {
  const PrintedRatios printed =
      printed_ratios(data, [](const auto& mps, const auto& wcsph) { return mps.cpu_time_s / wcsph.cpu_time_s; });
  if (printed.words.empty()) return;
  Evidence ours;
  const auto cost_of = [](const AnalysedRun& run) { return per_simulated_second(run, processor_time_s(run)); };
  const auto [mps_cost, costly] = least(both.mps, cost_of);
  const auto [wcsph_cost, cheap] = least(both.wcsph, cost_of);
  if (mps_cost && wcsph_cost) {
    const double ratio = *mps_cost / *wcsph_cost;
    ours.words = fmt::format("{} times, {} to {}", fixed(ratio, 2), costly->key, cheap->key);
    ours.agrees = std::abs(ratio / printed.at_finest - 1) < 0.10;
  }
  add(table, fmt::format("MPS costs {} times WCSPH", fixed(printed.at_finest, 1)), printed.words, ours);
}

void add_steps(Table& table, const ReportData& data, const BothMethods& both) {
  const PrintedRatios printed =
      printed_ratios(data, [](const auto& mps, const auto& wcsph) { return mps.dt_s / wcsph.dt_s; });
  if (printed.words.empty()) return;
  Evidence ours;
  const auto steps_of = [](const AnalysedRun& run) { return per_simulated_second(run, run.record.number("steps")); };
  const auto [mps_steps, few] = least(both.mps, steps_of);
  const auto [wcsph_steps, many] = least(both.wcsph, steps_of);
  if (mps_steps && wcsph_steps) {
    const double ratio = *wcsph_steps / *mps_steps;
    ours.words = fmt::format("{} times, {} to {}", fixed(ratio, 1), many->key, few->key);
    ours.agrees = std::abs(ratio / printed.at_finest - 1) < 0.25;
  }
  add(table, "WCSPH takes many more steps than MPS", printed.words, ours);
}

/// One quantity of a force in each series of runs that differ in alpha alone: "WCSPH ...: 1.2 N at 0.1, 1.5 N at 0.01".
struct AlphaTrend {
  std::string words;
  std::vector<std::vector<std::pair<double, double>>> series;  ///< alpha and value, smallest alpha first
};

template <class Measure>
AlphaTrend alpha_trend(const ReportData& data, const std::string& sensor, const std::string& unit, Measure measure) {
  AlphaTrend trend;
  for (const AlphaSeries& runs : alpha_series(data)) {
    std::vector<std::pair<double, double>> points;
    std::string words;
    for (const AnalysedRun* run : runs.runs) {
      const SensorReading* reading = run->primary(sensor);
      const std::optional<double> value = reading == nullptr ? std::nullopt : measure(reading->comparison);
      if (!value) continue;
      points.emplace_back(*run->record.alpha(), *value);
      words += fmt::format("{}{} {} at {}", words.empty() ? "" : ", ", significant(*value, 3), unit,
                           shortest(points.back().first));
    }
    if (points.size() < 2) continue;
    trend.words += fmt::format("{}{}: {}", trend.words.empty() ? "" : "; ", runs.title, words);
    trend.series.push_back(std::move(points));
  }
  return trend;
}

void add_best_alpha(Table& table, const ReportData& data, const std::string& sensor, const std::string& paper) {
  constexpr double stated = 0.1;
  const AlphaTrend trend = alpha_trend(data, sensor, "%", [](const Comparison& c) -> std::optional<double> {
    return c.rmse_over_range ? std::optional(100 * *c.rmse_over_range) : std::nullopt;
  });
  Evidence ours{trend.words.empty() ? "" : "RMSE / range " + trend.words, true,
                data.measured_series(sensor) == nullptr};
  for (const auto& points : trend.series) {
    const auto best = std::min_element(points.begin(), points.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    ours.agrees = ours.agrees && std::abs(best->first / stated - 1) < 1e-9;
  }
  add(table, "α = 0.1 gives the best force", paper, ours);
}

void add_oscillations(Table& table, const ReportData& data, const std::string& sensor, const std::string& paper) {
  const AlphaTrend trend = alpha_trend(data, sensor, "N", [](const Comparison& c) { return c.noise.simulated; });
  Evidence ours{trend.words.empty() ? "" : "noise " + trend.words, true};
  for (const auto& points : trend.series)
    for (std::size_t k = 1; k < points.size(); ++k)
      ours.agrees = ours.agrees && points[k].second < points[k - 1].second;
  add(table, "Oscillations of the force grow as α falls", paper, ours);
}

void add_force_statements(Table& table, const ReportData& data) {
  for (const PublishedFigure& figure : data.the_case.published.figures) {
    const CaseSensor* sensor = data.the_case.find_sensor(figure.sensor);
    if (sensor == nullptr || sensor->kind != SensorKind::force) continue;
    const std::string paper = fmt::format("its figure {}; no numbers are printed", figure.number);
    add_best_alpha(table, data, figure.sensor, paper);
    add_oscillations(table, data, figure.sensor, paper);
  }
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
    add_accuracy(table, data);
    add_sign(table, data);
    add_alpha(table, data);
    table.notes.push_back("Errors: mean unsigned deviation of the impulses, primary readings.");
  }
  add_force_statements(table, data);
  const BothMethods both = finest_of_both(data);
  add_cost(table, data, both);
  add_steps(table, data, both);
  if (data.has(SensorKind::force))
    table.notes.push_back(
        "Oscillations: noise, the root mean square of what a 20 ms running mean takes away. Forces are primary "
        "readings.");
  table.notes.push_back(
      "Where both methods are compared, at the finest particle distance that has both, against what the paper prints "
      "at "
      "its finest. Costs: processor time per simulated second; they agree within a tenth, steps within a quarter.");
  return table;
}

}  // namespace sluice
