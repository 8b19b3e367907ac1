// The report's tables, each made from the analysed runs alone.
#pragma once

#include "reports/analysis.h"
#include "reports/table.h"

namespace sluice {

/// Which runs the report is about, with their state.
Table runs_table(const ReportData& data);
/// The paper's Table 1: numerical parameters and processing time, its own rows first.
Table parameters_table(const ReportData& data);
/// Every solver parameter as recorded in the manifests, one column a run.
Table solver_parameters_table(const ReportData& data);
/// Share of each phase in the time of a step, one row a run.
Table phases_table(const ReportData& data);
/// Energy, compression and losses of the fluid, one row a run.
Table conservation_table(const ReportData& data);
/// Processor time per simulated second of MPS and WCSPH runs of equal particle distance; no rows without such a pair.
Table cost_ratio_table(const ReportData& data);
/// Where each run's numbers come from: directory, commit, compiler, machine, hashes.
Table provenance_table(const ReportData& data);
/// Lengths that were fitted to the lattice, and the fluid volume.
Table fitted_lengths_table(const ReportData& data);

/// The paper's Table 2: impulses of its sensors with unsigned deviations, its own rows first.
Table paper_impulses_table(const ReportData& data);
/// Impulses of every pressure sensor; `relative`: their signed deviations instead.
Table impulses_table(const ReportData& data, bool relative);

/// Runs that end before the window does, scored over what they cover, beside all that reach as far; no rows when there
/// are none.
Table early_runs_table(const ReportData& data);

/// Share of the time that a reading lies inside the measured band [%]; a dash where the measurement is no band.
TableCell inside_band(const ReportData& data, const SensorReading& reading);
/// Arrival, peaks, errors, lag, band share and noise of every sensor of a kind. `all_models` false: primary readings.
Table sensor_metrics_table(const ReportData& data, SensorKind kind, bool all_models);

/// Peak, arrival and rise of every force, by both routes.
Table force_peaks_table(const ReportData& data);
/// Impulses of one force over its windows, errors, band share and noise, by both routes.
Table force_impulses_table(const ReportData& data, const std::string& sensor);
/// Peak, impulse and noise of every force against the artificial viscosity.
Table force_alpha_table(const ReportData& data);

/// What a length that the case leaves open does to the headline sensors; no rows without two values of one.
Table placements_table(const ReportData& data);

/// How much fluid the kernel probe saw: share of the time after the measured arrival in which it could read at all.
Table kernel_support_table(const ReportData& data);

/// Impulses by wall model and sensor model for runs alike in all else.
Table boundary_models_table(const ReportData& data);
/// Impulse deviations against the artificial viscosity, one row a run.
Table alpha_table(const ReportData& data);
/// Errors against the particle distance with the observed order.
Table resolution_table(const ReportData& data);

/// Bias and relative standard deviation of each method, quantity by quantity.
Table bias_table(const ReportData& data);
/// Comparison errors against what is known of the validation uncertainty; no rows without a series of resolutions, or
/// without a measurement.
Table validation_uncertainty_table(const ReportData& data);
/// Which alpha has the smallest error for which quantity; no rows without runs that differ in alpha alone, or without a
/// measurement.
Table best_alpha_table(const ReportData& data);

/// The paper's statements with its evidence, ours, and a verdict.
Table conclusions_table(const ReportData& data);

/// The case's acceptance rows, evaluated for every run that they apply to.
Table acceptance_matrix(const ReportData& data);
/// How many rows passed and failed over all runs.
struct AcceptanceCount {
  int passed = 0;
  int failed = 0;
  int missing = 0;
};
AcceptanceCount count_acceptance(const ReportData& data);

}  // namespace sluice
