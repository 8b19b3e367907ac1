#include "reports/sections.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/studies.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

ReportSection summary_section(const ReportData& data) {
  ReportSection section{"summary", "Summary", {}};
  section.blocks.push_back(BulletList{findings(data)});
  section.blocks.push_back(hint(
      "Every sentence above is computed from the runs named below. Unless said otherwise a run is judged by its "
      "primary readings: the sensor models that the case file names for its solver and its walls. “Missing” means that "
      "there is no value: nobody measured it or the measured series cannot tell it, a run did not record it or did not "
      "get far enough to have it, a threshold was never reached, or the best lag lies at the limit of the search."));
  if (!data.the_case.assumptions.empty()) {
    section.blocks.push_back(Paragraph{"**Assumptions of the case**, where its sources are silent:"});
    section.blocks.push_back(BulletList{data.the_case.assumptions});
  }
  section.blocks.push_back(runs_table(data));
  for (const std::string& problem : data.measured.problems())
    section.blocks.push_back(Paragraph{"**No measurement**: " + problem + ". What needs it is missing throughout."});
  return section;
}

ReportSection parameters_section(const ReportData& data) {
  ReportSection section{"parameters", "Parameters and cost of each run", {}};
  section.blocks.push_back(parameters_table(data));
  section.blocks.push_back(hint(
      "Equivalent viscosity: ν = α h c₀ / (2 (dim + 2)). A particle-step is one fluid particle moved by one time step; "
      "the rate counts the time spent stepping. Rates of codes on different machines say little by themselves."));
  return section;
}

// Forces by walls stand side by side in their own tables.
void add_walls_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  if (wall_pairs(maker.data).empty() || !maker.data.has(SensorKind::pressure)) return;
  ReportSection section{"walls", "Boundary models and sensor models", {}};
  section.blocks.push_back(hint(fmt::format(
      "Each group holds two runs that differ in their walls alone, and the paper's own numbers at the same α. Down a "
      "group one sees what the walls do to the error; between the rows of one run, what the probe does. The paper used "
      "`dynamic` walls and the `kernel` probe{}. The wall's own pressure with `dynamic` walls is shown as a warning "
      "only: its density can rise but never fall below the reference.",
      published_distance(maker.data, "wcsph"))));
  section.blocks.push_back(boundary_models_table(maker.data));
  append(section, boundary_model_figures(maker));
  sections.push_back(std::move(section));
}

void add_alpha_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  if (alpha_series(maker.data).empty()) return;
  ReportSection section{"alpha", "Artificial viscosity", {}};
  section.blocks.push_back(hint(std::string("Runs that differ in α alone are joined by a line.") +
                                (maker.data.has(SensorKind::pressure) ? " Zero is the measurement." : "")));
  if (maker.data.has(SensorKind::pressure)) {
    append(section, alpha_figures(maker));
    section.blocks.push_back(alpha_table(maker.data));
  }
  if (maker.data.has(SensorKind::force)) {
    append(section, force_alpha_figures(maker));
    section.blocks.push_back(force_alpha_table(maker.data));
  }
  if (Table best = best_alpha_table(maker.data); !best.rows.empty()) section.blocks.push_back(std::move(best));
  sections.push_back(std::move(section));
}

void add_placements_section(std::vector<ReportSection>& sections, const ReportData& data) {
  Table table = placements_table(data);
  if (table.rows.empty()) return;
  ReportSection section{"placements", "Lengths that the sources leave open", {}};
  section.blocks.push_back(
      hint("Runs that differ in one such length alone. What changes from row to row is what the "
           "assumption may cost."));
  section.blocks.push_back(std::move(table));
  sections.push_back(std::move(section));
}

void add_resolution_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  ReportSection section{"resolution", "Resolution", {}};
  const auto series = resolution_series(maker.data);
  if (series.empty()) {
    section.blocks.push_back(
        Paragraph{"No two runs differ in the particle distance alone: nothing can be said about "
                  "convergence from these runs."});
    sections.push_back(std::move(section));
    return;
  }
  section.blocks.push_back(
      hint("An error that shrinks with l0 is a good sign; an order of convergence needs three resolutions whose values "
           "approach one side monotonically. Where they do not, the words “not in the asymptotic range” stand in its "
           "place."));
  append(section, resolution_figures(maker));
  section.blocks.push_back(resolution_table(maker.data));
  sections.push_back(std::move(section));
}

void add_uncertainty_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  Table bias = bias_table(maker.data);
  if (bias.rows.empty()) return;
  ReportSection section{"uncertainty", "Bias, scatter and uncertainty", {}};
  section.blocks.push_back(hint(
      "Is a method wrong always the same way (bias), or now this way and now that (scatter)? And is an error larger "
      "than what resolution and measurement leave open? Only then does it say something of the method itself."));
  append(section, bias_figures(maker));
  section.blocks.push_back(std::move(bias));
  if (Table table = validation_uncertainty_table(maker.data); !table.rows.empty())
    section.blocks.push_back(std::move(table));
  sections.push_back(std::move(section));
}

void add_snapshot_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  ReportSection section{"snapshots", "The flow", {}};
  const auto pictures = snapshot_figures(maker);
  if (pictures.empty()) {
    section.blocks.push_back(
        Paragraph{"No run kept snapshots at the case's times, so there is no picture of the flow "
                  "(remedy: `sluice run ... --snapshots`)."});
  } else {
    section.blocks.push_back(
        hint(std::string("The view is oblique, from the near side wall and above, x to the right. Colour is ") +
             (maker.data.the_case.published.snapshots_colour == "velocity"
                  ? "speed over √(g H_W), the speed of a long wave on the still water: a front on a dry bed runs at 2."
                  : "pressure over the hydrostatic pressure at the bottom of the still column, so a calm column runs "
                    "from 0 to 1.")));
    append(section, pictures);
  }
  sections.push_back(std::move(section));
}

void add_acceptance_section(std::vector<ReportSection>& sections, const ReportData& data) {
  if (data.the_case.acceptance.empty()) return;
  ReportSection section{"acceptance", "Acceptance", {}};
  const AcceptanceCount count = count_acceptance(data);
  section.blocks.push_back(Paragraph{
      fmt::format("{} rows passed, {} failed, {} could not be evaluated.", count.passed, count.failed, count.missing)});
  section.blocks.push_back(hint(
      "The bounds stand in the case file, which says of each group what it is: a target, or (at the quick tiers) "
      "a band around earlier results of the solvers here, for noticing change; or in the file of bands that a group "
      "names. A value on the bound passes. Bounds of deviations are signed, (simulated − measured) / measured."));
  section.blocks.push_back(acceptance_matrix(data));
  sections.push_back(std::move(section));
}

void add_geometry_section(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  const auto pictures = geometry_figures(maker);
  if (pictures.empty()) return;
  ReportSection section{"geometry", "Geometry", {}};
  append(section, pictures);
  append(section, sensor_face_figures(maker));
  sections.push_back(std::move(section));
}

void add_conclusions_section(std::vector<ReportSection>& sections, const ReportData& data) {
  Table statements = conclusions_table(data);
  if (statements.rows.empty()) return;
  ReportSection section{"conclusions", "The paper's statements", {}};
  section.blocks.push_back(std::move(statements));
  sections.push_back(std::move(section));
}

ReportSection conservation_section(const FigureMaker& maker) {
  ReportSection section{"conservation", "Energy and compression", {}};
  append(section, conservation_figures(maker));
  section.blocks.push_back(conservation_table(maker.data));
  return section;
}

ReportSection cost_section(const FigureMaker& maker) {
  ReportSection section{"cost", "Error and cost", {}};
  append(section, cost_figures(maker));
  if (maker.enabled && section.blocks.empty())
    section.blocks.push_back(
        BulletList{{"No plot of error against cost: it takes two runs with a processor time and an "
                    "error of measured impulses of pressure."}});
  Table ratio = cost_ratio_table(maker.data);
  if (!ratio.rows.empty()) section.blocks.push_back(std::move(ratio));
  section.blocks.push_back(phases_table(maker.data));
  return section;
}

/// Why a primary reading lacks something, where it is not that the run does not cover the window, which is told once.
void add_missing_metrics(BulletList& list, const ReportData& data, const AnalysedRun& run) {
  for (const SensorReading& reading : run.readings) {
    const bool told = !reading.primary || data.measured_series(reading.sensor) == nullptr ||
                      !covers(reading.series, data.window_of(reading.sensor));
    if (told) continue;
    for (const std::string& remark : reading.comparison.remarks)
      list.items.push_back(fmt::format("{}: {}: {}", run.key, reading.sensor, remark));
  }
}

void add_warnings(ReportSection& section, const ReportData& data) {
  BulletList list;
  for (const AnalysedRun& run : data.runs) {
    for (const std::string& warning : run.record.warnings()) list.items.push_back(run.key + ": " + warning);
    for (const std::string& problem : run.problems) list.items.push_back(run.key + ": " + problem);
    add_missing_metrics(list, data, run);
  }
  for (std::string& mixed : mixed_builds(data)) list.items.push_back(std::move(mixed));
  if (list.items.empty()) list.items.push_back("No run recorded a warning.");
  section.blocks.push_back(Paragraph{"**Warnings**"});
  section.blocks.push_back(std::move(list));
}

ReportSection provenance_section(const ReportData& data) {
  ReportSection section{"provenance", "Provenance", {}};
  section.blocks.push_back(provenance_table(data));
  add_warnings(section, data);
  section.blocks.push_back(fitted_lengths_table(data));
  section.blocks.push_back(solver_parameters_table(data));
  section.blocks.push_back(Paragraph{"Experiment: " + data.the_case.reference});
  if (!data.the_case.published.reference.empty())
    section.blocks.push_back(Paragraph{"Published values: " + data.the_case.published.reference + " Kept as printed."});
  section.blocks.push_back(Paragraph{
      "Every table lies beside this page as CSV (full precision) and LaTeX in `tables/`. `sluice report` leaves every "
      "figure as a gnuplot script with its data in `figures/`, but for the particles of snapshots; sets that are kept "
      "on record have the pictures only."});
  return section;
}

}  // namespace

std::vector<ReportSection> report_sections(const FigureMaker& maker, bool snapshots) {
  const ReportData& data = maker.data;
  std::vector<ReportSection> sections;
  sections.push_back(summary_section(data));
  add_geometry_section(sections, maker);
  sections.push_back(parameters_section(data));
  add_sensor_sections(sections, maker);
  add_walls_section(sections, maker);
  add_alpha_section(sections, maker);
  add_placements_section(sections, data);
  add_resolution_section(sections, maker);
  add_uncertainty_section(sections, maker);
  if (snapshots && maker.enabled) add_snapshot_section(sections, maker);
  add_conclusions_section(sections, data);
  sections.push_back(conservation_section(maker));
  add_acceptance_section(sections, data);
  sections.push_back(cost_section(maker));
  sections.push_back(provenance_section(data));
  return sections;
}

}  // namespace sluice
