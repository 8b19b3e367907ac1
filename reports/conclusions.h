// What the rows on the paper's statements share: how a statement is judged, and by which runs.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/analysis.h"
#include "reports/table.h"

namespace sluice::conclusions {

enum class Verdict {
  agrees,
  does_not_agree,
  not_told,        ///< the difference is no larger than what runs scatter by
  no_measurement,  ///< the statement needs one that nobody supplied
};

/// On the claim that one error is smaller than another. Runs that differ in nothing but rounding scatter by a few per
/// cent, so that less than a tenth decides nothing.
Verdict smaller(double claimed, double other);
/// On a claim made of several: all have to hold.
Verdict all_of(Verdict a, Verdict b);

/// What our runs say to a statement; no words: nothing can be said.
struct Evidence {
  std::string words;
  Verdict verdict = Verdict::does_not_agree;
};

/// A row: the statement, the paper's evidence, ours, and the verdict.
void add(Table& table, const std::string& statement, const std::string& paper, const Evidence& ours);

std::string percent(double share);

/// Which runs of WCSPH a statement is judged by. The paper's walls and ours err each in its own way, so that a verdict
/// over both says nothing of either: one a wall model, or all runs where there is one model only.
struct WallsScope {
  std::optional<std::string> walls;

  bool has(const AnalysedRun& run) const { return !walls || run.record.walls == *walls; }
  /// The statement with the walls that it is judged for.
  std::string named(const std::string& statement) const;
};

/// One a wall model of our WCSPH runs.
std::vector<WallsScope> walls_scopes(const ReportData& data);
/// The same with those of other codes' runs that differ in alpha alone.
std::vector<WallsScope> alpha_scopes(const ReportData& data);

/// What the runs have set otherwise by which a method of this program is judged. These are finished runs, whole ones if
/// there are any, with the case's parameters or, where there are none, the largest set that is alike in what it
/// changes.
std::map<std::string, double> judged_parameters(const ReportData& data, const std::string& solver,
                                                const WallsScope& scope);
/// A note on every method that is judged by other parameters than the case's.
void note_judged_parameters(Table& table, const ReportData& data);
/// The runs of a method by which it is judged.
std::vector<const AnalysedRun*> judged_runs(const ReportData& data, const std::string& solver,
                                            const WallsScope& scope = {});

/// Judged runs of MPS and WCSPH at the finest particle distance that has both; where no such runs reach the window's
/// end, shorter ones.
struct BothMethods {
  std::vector<const AnalysedRun*> mps;
  std::vector<const AnalysedRun*> wcsph;
  double l0_m = 0;
};
BothMethods finest_of_both(const ReportData& data, const WallsScope& scope = {});

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

/// The sensors of a kind that the paper shows, and where: "its figures 4, 5, 6; no numbers are printed".
struct ShownSensors {
  std::vector<std::string> names;
  std::string evidence;
};
ShownSensors shown_sensors(const ReportData& data, SensorKind kind);

/// Mean of a quantity over some sensors' primary readings, given as SensorReading; missing when one of them is.
template <class Measure>
std::optional<double> mean_over(const std::vector<std::string>& sensors, const AnalysedRun& run, Measure measure) {
  if (sensors.empty()) return std::nullopt;
  double sum = 0;
  for (const std::string& sensor : sensors) {
    const SensorReading* reading = run.primary(sensor);
    const std::optional<double> value = reading == nullptr ? std::nullopt : measure(*reading);
    if (!value) return std::nullopt;
    sum += *value;
  }
  return sum / static_cast<double>(sensors.size());
}

/// The alphas that the paper prints for WCSPH.
std::vector<double> published_alphas(const ReportData& data);

/// "MPS is more accurate in impulse"
void add_accuracy(Table& table, const ReportData& data);
/// "WCSPH underestimates the impulses"
void add_sign(Table& table, const ReportData& data);
/// "MPS pressures oscillate less than WCSPH's", where the paper shows pressures.
void add_pressure_oscillations(Table& table, const ReportData& data);
/// "α ≤ 0.001 gives better impulses"
void add_alpha(Table& table, const ReportData& data);
/// "α ≤ 0.01 gives better wave heights", where the paper shows them.
void add_wave_heights(Table& table, const ReportData& data);
/// "α = 0.1 gives the best force" and "Oscillations of the force grow as α falls", for every force that it shows.
void add_force_statements(Table& table, const ReportData& data);

}  // namespace sluice::conclusions
