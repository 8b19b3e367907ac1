// Figures of what the sensors saw over time.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "reports/quantity.h"
#include "reports/series_panels.h"
#include "reports/studies.h"

namespace sluice {
namespace {

/// Readings with spikes are drawn up to this multiple of the measured peak: a water-hammer spike would hide all else.
constexpr double headroom = 1.5;

int published_number(const ReportData& data, const std::string& sensor) {
  for (const PublishedFigure& figure : data.the_case.published.figures)
    if (figure.sensor == sensor) return figure.number;
  return 0;
}

std::string paper_remark(const ReportData& data, const std::string& sensor) {
  const int number = published_number(data, sensor);
  return number > 0 ? fmt::format(" (the paper's figure {})", number) : "";
}

/// 1.5 times the measured peak, as drawn; zero where nothing was measured or no reading has spikes.
Cut spike_limit(const ReportData& data, const CaseSensor& sensor) {
  const Quantity& q = quantity_of(sensor.kind);
  const MeasuredSeries* measured = data.measured_series(sensor.name);
  if (!q.spikes || measured == nullptr || measured->maximum.empty()) return {};
  return {q.drawn_scale * headroom * *std::max_element(measured->maximum.begin(), measured->maximum.end()),
          q.drawn_unit, ""};
}

/// "Pressure at P1"
std::string headed(const CaseSensor& sensor) {
  const Quantity& q = quantity_of(sensor.kind);
  return fmt::format("{}{} {}", static_cast<char>(std::toupper(q.what.front())), q.what.substr(1), sensor.name);
}

std::string axis_remark(const Cut& cut) {
  if (cut.words.empty()) return "";
  return fmt::format(" The axis ends at {:.1f} {}; beyond it: {}.", cut.limit, cut.unit, cut.words);
}

constexpr const char* smoothed_words = "runs after a 10 ms running mean, ";

/// Panels of one sensor over one range, so that groups of runs can be compared by eye.
void share_range(std::vector<PlotPanel>& panels, const Cut& cut) {
  double low = 1e300;
  double high = -1e300;
  const auto show = [&](const std::vector<double>& values) {
    for (double y : values) {
      if (!std::isfinite(y)) continue;
      low = std::min(low, y);
      high = std::max(high, y);
    }
  };
  for (const PlotPanel& panel : panels) {
    for (const PlotCurve& curve : panel.curves) show(curve.y);
    for (const PlotBand& band : panel.bands) {
      show(band.lower);
      show(band.upper);
    }
  }
  if (!(low < high)) return;
  const double margin = 0.04 * (high - low);
  for (PlotPanel& panel : panels) {
    panel.y_range.first = low >= 0 ? 0 : low - margin;
    panel.y_range.second = cut.words.empty() ? high + margin : cut.limit;
  }
}

/// From just before the first arrival, in the measurement or in a run, to a third of a second after the measured one.
Window impact_window(const ReportData& data, const std::string& sensor, double arrival_s) {
  constexpr double earliest_s = 0.8;
  double first = arrival_s;
  for (const AnalysedRun& run : data.runs)
    if (const SensorReading* reading = run.primary(sensor))
      first = std::min(first, reading->comparison.arrival_s.simulated.value_or(first));
  first = std::max(first, arrival_s - earliest_s);
  return {std::max(data.window.begin_s, first - 0.06), std::min(data.window.end_s, arrival_s + 0.34)};
}

}  // namespace

std::vector<Picture> series_figures(const FigureMaker& maker, SensorKind kind, bool raw) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  const Quantity& q = quantity_of(kind);
  for (const CaseSensor& sensor : data.the_case.sensors) {
    if (sensor.kind != kind) continue;
    Cut cut = spike_limit(data, sensor);
    const bool smoothed = q.spikes && !raw;
    auto panels = sensor_panels(data, sensor, {"", data.window, smoothed}, cut);
    if (panels.empty()) continue;
    share_range(panels, cut);
    const std::string caption =
        fmt::format("{}{}: {}primary reading.{}", headed(sensor), paper_remark(data, sensor.name),
                    smoothed   ? smoothed_words
                    : q.spikes ? "raw, "
                               : "",
                    axis_remark(cut));
    pictures.push_back(draw_series(maker, q.stem + "_" + sensor.name + (raw ? "_raw" : ""), std::move(panels),
                                   with_remark(data, sensor, caption),
                                   fmt::format("{} over time, experiment and runs", axis_name(sensor))));
  }
  return pictures;
}

std::vector<Picture> method_figures(const FigureMaker& maker, SensorKind kind) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  const bool smoothed = quantity_of(kind).spikes;
  for (const CaseSensor& sensor : data.the_case.sensors) {
    const int number = published_number(data, sensor.name);
    if (sensor.kind != kind || number == 0) continue;
    Cut cut = spike_limit(data, sensor);
    auto panels = shared_panels(data, method_groups(data, runs_a_panel), sensor, {"", data.window, smoothed}, cut);
    if (panels.empty()) continue;
    share_range(panels, cut);
    const std::string caption =
        fmt::format("{} as the paper's figure {} sets it out, both methods on one axis: {}primary readings.{}",
                    headed(sensor), number, smoothed ? smoothed_words : "", axis_remark(cut));
    pictures.push_back(draw_series(maker, "methods_" + sensor.name, std::move(panels),
                                   with_remark(data, sensor, caption),
                                   fmt::format("{} over time, experiment, MPS and WCSPH", axis_name(sensor))));
  }
  return pictures;
}

std::vector<Picture> other_code_figures(const FigureMaker& maker, SensorKind kind) {
  std::vector<Picture> pictures;
  const ReportData& data = maker.data;
  const std::vector<RunGroup> all_groups = beside_references(data, runs_a_panel);
  if (!maker.enabled || all_groups.empty()) return pictures;
  const bool smoothed = quantity_of(kind).spikes;
  for (const CaseSensor& sensor : data.the_case.sensors) {
    if (sensor.kind != kind) continue;
    std::vector<RunGroup> groups = all_groups;
    std::erase_if(groups, [&](const RunGroup& group) {
      return std::none_of(group.runs.begin(), group.runs.end(), [&](const AnalysedRun* run) {
        return !run->record.own && run->primary(sensor.name) != nullptr;
      });
    });
    Cut cut = spike_limit(data, sensor);
    auto panels = shared_panels(data, groups, sensor, {"", data.window, smoothed}, cut);
    if (panels.empty()) continue;
    share_range(panels, cut);
    const std::string caption = fmt::format("{}, other codes on one axis: {}primary readings.{}", headed(sensor),
                                            smoothed ? smoothed_words : "", axis_remark(cut));
    pictures.push_back(draw_series(maker, "codes_" + sensor.name, std::move(panels), with_remark(data, sensor, caption),
                                   fmt::format("{} over time, experiment and other codes", axis_name(sensor))));
  }
  return pictures;
}

std::vector<Picture> spray_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  for (const CaseSensor& sensor : maker.data.the_case.sensors) {
    if (sensor.kind != SensorKind::wave_height) continue;
    Cut none;
    auto panels = sensor_panels(maker.data, sensor, {"top", maker.data.window, false}, none);
    if (panels.empty()) continue;
    pictures.push_back(
        draw_series(maker, "wave_" + sensor.name + "_top", std::move(panels),
                    fmt::format("Highest water on the line of {}, spray included (model top).", sensor.name),
                    fmt::format("Highest water at {} over time, experiment and runs", sensor.name)));
  }
  return pictures;
}

std::vector<Picture> impact_figures(const FigureMaker& maker, SensorKind kind) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  const Quantity& q = quantity_of(kind);
  for (const CaseSensor& sensor : data.the_case.sensors) {
    if (sensor.kind != kind) continue;
    std::optional<double> arrival;
    if (const MeasuredSeries* measured = data.measured_series(sensor.name))
      arrival = arrival_at_fraction_of_peak(*measured, data.window_of(sensor.name));
    for (const AnalysedRun& run : data.runs)
      if (const SensorReading* reading = run.primary(sensor.name); reading != nullptr && !arrival)
        arrival = reading->comparison.arrival_s.simulated;
    if (!arrival) continue;
    Cut none;
    auto panels = sensor_panels(data, sensor, {"", impact_window(data, sensor.name, *arrival), false}, none);
    if (panels.empty()) continue;
    const std::string stem = kind == SensorKind::pressure ? "impact_" : q.stem + "_impact_";
    pictures.push_back(draw_series(
        maker, stem + sensor.name, std::move(panels),
        with_remark(data, sensor, fmt::format("First impact at {}: raw readings, nothing cut.", sensor.name)),
        fmt::format("{} around the first impact", axis_name(sensor))));
  }
  return pictures;
}

}  // namespace sluice
