// The sections that show what the sensors saw: impulses, pressures, wave heights, forces, velocities. A case without
// sensors of a kind has no section of it.
#include "reports/sections.h"
#include "reports/tables.h"

namespace sluice {
namespace {

void add_early_runs(ReportSection& section, const ReportData& data) {
  if (data.measured_series(data.headline_sensors().front()) == nullptr) return;
  Table early = early_runs_table(data);
  if (!early.rows.empty()) section.blocks.push_back(std::move(early));
}

/// Where the paper has such a figure and both methods were run at one particle distance.
void add_both_methods(ReportSection& section, const FigureMaker& maker, SensorKind kind) {
  const auto pictures = method_figures(maker, kind);
  if (pictures.empty()) return;
  section.blocks.push_back(Paragraph{"**Both methods on one axis**, as the paper draws them:"});
  append(section, pictures);
}

/// Where there are runs of other codes: what their authors look for comes first.
void add_other_codes(ReportSection& section, const FigureMaker& maker, SensorKind kind) {
  const auto pictures = other_code_figures(maker, kind);
  if (pictures.empty()) return;
  section.blocks.push_back(
      Paragraph{"**Other codes on one axis**, with the run that stands for each method here where there is one:"});
  append(section, pictures);
  section.blocks.push_back(Paragraph{"**Each method and code by itself**:"});
}

ReportSection impulses_section(const FigureMaker& maker) {
  const ReportData& data = maker.data;
  ReportSection section{"impulses", "Pressure impulses", {}};
  section.blocks.push_back(
      hint("The impulse is the integral of pressure over time. It does not hang on the shape of a peak that lasts a "
           "millisecond, so it is the fairest single number for a load. Each sensor model has its own row: `wall` is "
           "the mean "
           "pressure of the wall's particles around the sensor, `kernel` the normalised sum over the fluid one "
           "smoothing length "
           "in front of it (the paper's probe)."));
  if (!data.the_case.published.impulses.empty()) section.blocks.push_back(paper_impulses_table(data));
  append(section, impulse_figures(maker));
  section.blocks.push_back(impulses_table(data, true));
  Table values = impulses_table(data, false);
  values.folded = true;
  section.blocks.push_back(std::move(values));
  add_early_runs(section, data);
  return section;
}

ReportSection pressures_section(const FigureMaker& maker) {
  ReportSection section{"pressures", "Pressures on the box", {}};
  section.blocks.push_back(hint(
      "Black: the measurement, its mean in each bin; grey: lowest to highest sample in the bin. A weakly compressible "
      "fluid starts an impact on a flat face with a water-hammer spike that lasts a few milliseconds and whose height "
      "depends on the sampling. So the long views show a 10 ms running mean of the runs, the close views the raw "
      "readings. "
      "Curves are thinned for drawing, keeping the lowest and highest sample of each pixel column."));
  add_other_codes(section, maker, SensorKind::pressure);
  append(section, series_figures(maker, SensorKind::pressure));
  add_both_methods(section, maker, SensorKind::pressure);
  section.blocks.push_back(Paragraph{"**The first impact**, raw:"});
  append(section, impact_figures(maker, SensorKind::pressure));
  section.blocks.push_back(sensor_metrics_table(maker.data, SensorKind::pressure, false));
  section.blocks.push_back(hint(
      "Arrival: first crossing of 10 % of the measured peak, in both series. Noise: root mean square of what a 20 ms "
      "running mean takes away. Inside band: share of time between the lowest and the highest measured sample. Best "
      "lag: "
      "shift of best correlation, positive when the simulation is late."));
  section.blocks.push_back(kernel_support_table(maker.data));
  Table all = sensor_metrics_table(maker.data, SensorKind::pressure, true);
  all.folded = true;
  section.blocks.push_back(std::move(all));
  if (!maker.data.the_case.published.impulses.empty())
    section.blocks.push_back(Paragraph{
        "Curves of the mesh-based codes FreSCo and ConFlow, which the paper shows beside its own, exist as printed "
        "figures only; no numbers were published, so none are drawn here."});
  return section;
}

ReportSection waves_section(const FigureMaker& maker) {
  ReportSection section{"waves", "Wave heights", {}};
  section.blocks.push_back(
      hint("Two ways to read a height: `column` is the first gap counted from the bed upwards, as a wire probe in "
           "solid water "
           "sees it; `top` is the highest water on the line, spray included. They differ where the wave overturns."));
  add_other_codes(section, maker, SensorKind::wave_height);
  append(section, series_figures(maker, SensorKind::wave_height));
  const auto spray = spray_figures(maker);
  if (!spray.empty()) section.blocks.push_back(Paragraph{"**The same probes with spray** (model `top`):"});
  append(section, spray);
  add_both_methods(section, maker, SensorKind::wave_height);
  section.blocks.push_back(sensor_metrics_table(maker.data, SensorKind::wave_height, true));
  return section;
}

ReportSection force_section(const FigureMaker& maker) {
  const ReportData& data = maker.data;
  ReportSection section{"forces", "Forces", {}};
  section.blocks.push_back(hint(
      "A force is read by two routes: `acceleration` sums mass times the acceleration that the fluid would give to "
      "the wall's particles (the paper's reading of WCSPH), `pressure` the pressures of the first layer times its "
      "area (the paper's of MPS). In still water they agree within a few per cent; how far they part in a flow "
      "says how far to trust either. Black: the measured mean; grey: the band of the measured points. Long views show "
      "a 10 ms running "
      "mean of the runs, then the raw readings; close views show the first impact, raw."));
  add_other_codes(section, maker, SensorKind::force);
  append(section, series_figures(maker, SensorKind::force));
  append(section, series_figures(maker, SensorKind::force, true));
  append(section, impact_figures(maker, SensorKind::force));
  append(section, route_figures(maker));
  add_both_methods(section, maker, SensorKind::force);
  section.blocks.push_back(force_peaks_table(data));
  for (const std::string& sensor : data.sensors(SensorKind::force))
    section.blocks.push_back(force_impulses_table(data, sensor));
  if (!data.has(SensorKind::pressure)) add_early_runs(section, data);
  return section;
}

ReportSection velocity_section(const FigureMaker& maker) {
  ReportSection section{"velocities", "Velocities", {}};
  section.blocks.push_back(hint(
      "The fluid's kernel mean of one component of the velocity at a point. It reads zero where too little fluid is "
      "near, before the water comes and where it runs too shallow."));
  add_other_codes(section, maker, SensorKind::velocity);
  append(section, series_figures(maker, SensorKind::velocity));
  add_both_methods(section, maker, SensorKind::velocity);
  section.blocks.push_back(sensor_metrics_table(maker.data, SensorKind::velocity, true));
  return section;
}

}  // namespace

void add_sensor_sections(std::vector<ReportSection>& sections, const FigureMaker& maker) {
  const ReportData& data = maker.data;
  if (data.has(SensorKind::force)) sections.push_back(force_section(maker));
  if (data.has(SensorKind::pressure)) {
    sections.push_back(impulses_section(maker));
    sections.push_back(pressures_section(maker));
  }
  if (data.has(SensorKind::wave_height)) sections.push_back(waves_section(maker));
  if (data.has(SensorKind::velocity)) sections.push_back(velocity_section(maker));
}

}  // namespace sluice
