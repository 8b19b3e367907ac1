// What became of the fluid as a whole: its energy, and how far it was compressed. Both come from columns that runs of
// this project record; another code may deliver them under the same names.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {
namespace {

constexpr const char* compression_column = "greatest_density_ratio_1";

/// Kinetic and potential energy together [J], or nothing where a run did not record them.
std::optional<Series> energy(const AnalysedRun& run) {
  const ProbeTable& probes = run.record.probes;
  if (!probes.has("kinetic_energy_J") || !probes.has("potential_energy_J") || probes.rows() == 0) return std::nullopt;
  Series sum = probes.column("kinetic_energy_J");
  sum.name = "energy";
  const std::vector<double>& potential = probes.values("potential_energy_J");
  for (std::size_t i = 0; i < sum.value.size(); ++i) sum.value[i] += potential[i];
  return sum;
}

std::optional<Series> compression(const AnalysedRun& run) {
  const ProbeTable& probes = run.record.probes;
  if (!probes.has(compression_column) || probes.rows() == 0) return std::nullopt;
  return probes.column(compression_column);
}

/// The largest rise above any earlier value.
double largest_rise(const std::vector<double>& values) {
  double least = values.front();
  double rise = 0;
  for (const double v : values) {
    least = std::min(least, v);
    rise = std::max(rise, v - least);
  }
  return rise;
}

std::optional<double> greatest(const std::optional<Series>& series, double from_s) {
  std::optional<double> most;
  if (!series) return most;
  for (std::size_t i = 0; i < series->t_s.size(); ++i)
    if (series->t_s[i] >= from_s) most = std::max(most.value_or(series->value[i]), series->value[i]);
  return most;
}

}  // namespace

Table conservation_table(const ReportData& data) {
  constexpr double later_s = 1.0;
  Table table;
  table.name = "conservation";
  table.caption = "Energy, compression and losses of the fluid";
  table.columns = {{"Run", "run", false},
                   {"E at the start [J]", "energy_start_J"},
                   {"E at the end / start [%]", "energy_end_percent"},
                   {"largest rise of E [%]", "energy_rise_percent"},
                   {"greatest density ratio", "density_ratio_max_1"},
                   {fmt::format("from {:g} s on", later_s), "density_ratio_max_later_1"},
                   {"through walls", "through_walls"},
                   {"over the top", "over_top"}};
  for (const AnalysedRun& run : data.runs) {
    const auto e = energy(run);
    const auto ratio = compression(run);
    const auto percent = [&](double joule) { return 100 * joule / e->value.front(); };
    const bool early = ended_early(data, run);  // there is less energy the later it is
    table.add({word(run.label), e ? number(e->value.front(), 1) : missing(),
               e && !early ? number(percent(e->value.back()), 1) : missing(),
               e ? number(percent(largest_rise(e->value)), 2) : missing(), number(greatest(ratio, 0), 3),
               early ? missing() : number(greatest(ratio, later_s), 3), typed(run.record.number("lost.through_walls")),
               typed(run.record.number("lost.over_top"))});
  }
  table.notes.push_back(
      "E: kinetic energy, and potential energy above the tank's floor. A scheme that adds none never rises; what a "
      "weakly "
      "compressible fluid stores in compression is not counted. Density ratio: the densest particle's density over the "
      "reference (MPS: its number density over n0).");
  return table;
}

std::vector<Picture> conservation_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  int index = 0;
  for (const RunGroup& group : run_groups(maker.data, runs_a_panel)) {
    PlotPanel energies;
    energies.title = group.title;
    energies.x_label = "time [s]";
    energies.y_label = "energy / energy at the start [%]";
    PlotPanel ratios = energies;
    ratios.y_label = "greatest density ratio";
    std::string source;
    int style = 0;
    for (const AnalysedRun* run : group.runs) {
      const auto e = energy(*run);
      const auto ratio = compression(*run);
      if (!e || !ratio) continue;
      energies.curves.push_back(run_curve(*run, *e, maker.data.window, style, 100 / e->value.front()));
      ratios.curves.push_back(run_curve(*run, *ratio, maker.data.window, style++, 1));
      source += (source.empty() ? "" : ", ") + run->label;
    }
    if (energies.curves.empty()) continue;
    PlotFigure figure;
    figure.name = fmt::format("conservation_{}", ++index);
    figure.panels = {energies, ratios};
    figure.source = source;
    pictures.push_back(draw_picture(maker, figure,
                                    fmt::format("Energy of the fluid and its densest particle, {}.", group.title),
                                    "Energy and greatest density ratio over time"));
  }
  return pictures;
}

}  // namespace sluice
