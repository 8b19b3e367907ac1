// Which runs differ in one thing only: in their walls, in alpha, in the particle distance, or in a placement. Runs
// whose other parameters differ are never set side by side as such. And which runs of the two methods belong together.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/analysis.h"

namespace sluice {

/// Pairs of runs alike in all but their wall models.
std::vector<std::pair<const AnalysedRun*, const AnalysedRun*>> wall_pairs(const ReportData& data);

/// One flow at one particle distance to one end, whatever the method.
bool same_flow(const ReportData& data, const RunRecord& a, const RunRecord& b);

/// Runs alike in all but alpha, at least two of them, smallest alpha first.
struct AlphaSeries {
  std::string title;  ///< "WCSPH, extrapolated walls, l0 = 20 mm"
  std::vector<const AnalysedRun*> runs;
};
std::vector<AlphaSeries> alpha_series(const ReportData& data);

/// Runs alike in all but l0, at least two of them, coarsest first.
struct ResolutionSeries {
  std::string title;  ///< "WCSPH, extrapolated walls, α = 0.01"
  std::vector<const AnalysedRun*> runs;
  std::vector<const AnalysedRun*> left_out;  ///< of two runs at one l0 the first stands for it
};
std::vector<ResolutionSeries> resolution_series(const ReportData& data);

/// Runs of both methods for one pair of axes, as the paper draws them: MPS first, so that it looks the same in every
/// group, then WCSPH with one wall model. All have one particle distance, end and geometry; a group holds some of both
/// methods and at most `limit` runs (two or more).
std::vector<RunGroup> method_groups(const ReportData& data, std::size_t limit);

/// Runs of other codes for one pair of axes with what they are to be held against: of each of our solvers and walls the
/// finest whole run with the case's parameters and alpha, where there is such a one. At most `limit` runs in each;
/// nothing where there are no runs of other codes, or where a run is all there is.
std::vector<RunGroup> beside_references(const ReportData& data, std::size_t limit);

/// Runs alike in all but one length that the case leaves open, at least two of them, smallest first.
struct PlacementSeries {
  std::string placement;
  std::string title;
  std::vector<const AnalysedRun*> runs;
};
std::vector<PlacementSeries> placement_series(const ReportData& data);
/// The value at which a run has it [m].
double placed_at_m(const Placement& placement, const RunRecord& run);
/// The case's obstacles where a run placed them.
std::vector<Obstacle> placed_obstacles(const Case& c, const RunRecord& run);

struct ResolutionPoint {
  double l0_m = 0;
  double value = 0;  ///< of the simulated quantity itself, whose convergence is looked at
  double error = 0;  ///< as shown, in the quantity's unit
};
struct ResolutionQuantity {
  std::string name;  ///< with the unit of the error
  int decimals = 1;
  std::vector<ResolutionPoint> points;  ///< coarsest first; runs without the quantity are left out
  bool shows_value = false;             ///< the value is shown, not an error: nothing has to be measured for it
  std::string model{};                  ///< of the readings; empty: the primary ones
};
/// Impulses of the headline sensors in every model, arrival at the first of them, RMSE of every wave probe, and peak
/// and impulse of every force as they are.
std::vector<ResolutionQuantity> resolution_quantities(const ReportData& data, const ResolutionSeries& series);

/// (printed - printed experiment) / printed experiment of the paper's impulse, signed.
std::optional<double> published_deviation(const ReportData& data, const std::string& sensor, const std::string& source,
                                          std::optional<double> alpha);

/// The mean of its unsigned deviations over the headline sensors; missing when one of them is.
std::optional<double> published_mean(const ReportData& data, const std::string& solver, std::optional<double> alpha);

/// The paper's run of a solver; nullptr when it prints none.
const PublishedRun* published_run(const Case& c, const std::string& solver);
/// ", l0 = 7.5 mm" of that run; "" when it prints none.
std::string published_distance(const ReportData& data, const std::string& solver);

/// What is compared as if one thing alone differed, and was made by several builds: one sentence for each study.
std::vector<std::string> mixed_builds(const ReportData& data);

}  // namespace sluice
