// Figures of what the sensors saw over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/figures.h"
#include "reports/plot.h"
#include "reports/text.h"

namespace sluice {

Picture draw_picture(const FigureMaker& maker, const PlotFigure& figure, const std::string& caption,
                     const std::string& description, bool wide) {
  draw(figure, maker.report_folder / "figures");
  return {figure.name, caption, description, std::filesystem::path("figures") / (figure.name + ".svg"), wide};
}

PlotCurve run_curve(const AnalysedRun& run, const Series& series, Window window, int style, double unit) {
  constexpr int pixel_columns = 450;
  PlotCurve curve;
  curve.label = run.short_label;
  curve.style = style;
  std::tie(curve.x, curve.y) = thin_out(series.t_s, series.value, window.begin_s, window.end_s, pixel_columns);
  for (double& y : curve.y) y *= unit;
  return curve;
}

namespace {

constexpr double most_bins = 700;
constexpr double smoothing_s = 0.01;
/// Pressures are drawn up to this multiple of the measured peak: a water-hammer spike would hide everything else.
constexpr double headroom = 1.5;

/// Which reading of a run a figure shows: a model, or the primary one when empty.
const SensorReading* reading_of(const AnalysedRun& run, const std::string& sensor, const std::string& model) {
  return model.empty() ? run.primary(sensor) : run.find(sensor, model);
}

int published_number(const ReportData& data, const std::string& sensor) {
  for (const PublishedFigure& figure : data.the_case.published.figures)
    if (figure.sensor == sensor) return figure.number;
  return 0;
}

std::string paper_remark(const ReportData& data, const std::string& sensor) {
  const int number = published_number(data, sensor);
  return number > 0 ? fmt::format(" (the paper's figure {})", number) : "";
}

/// Pressures are drawn in kPa.
double drawn_unit(SensorKind kind) {
  return kind == SensorKind::pressure ? 1e-3 : 1.0;
}

/// Neighbouring bins drawn as one, so that a long view holds no more of them than can be told apart.
std::size_t bins_drawn_as_one(const MeasuredSeries& measured, Window window) {
  const double bins = (window.end_s - window.begin_s) / measured.bin_s;
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(bins / most_bins)));
}

void add_experiment(PlotPanel& panel, const MeasuredSeries* measured, Window window, double unit) {
  if (measured == nullptr) return;
  const std::size_t merged = bins_drawn_as_one(*measured, window);
  const double width_s = static_cast<double>(merged) * measured->bin_s;
  PlotBand band{fmt::format("experiment, range in {:g} ms", 1000 * width_s), {}, {}, {}};
  PlotCurve mean{
      fmt::format("experiment, mean of {:g} ms", 1000 * width_s), {}, {}, CurveLook::experiment, 0, false, false, {}};
  for (std::size_t i = 0; i + merged <= measured->t_s.size(); i += merged) {
    const double t = 0.5 * (measured->t_s[i] + measured->t_s[i + merged - 1]);
    if (t < window.begin_s || t > window.end_s) continue;
    const auto from = static_cast<std::ptrdiff_t>(i);
    const auto to = static_cast<std::ptrdiff_t>(i + merged);
    const double sum = std::accumulate(measured->mean.begin() + from, measured->mean.begin() + to, 0.0);
    band.x.push_back(t);
    band.lower.push_back(unit * *std::min_element(measured->minimum.begin() + from, measured->minimum.begin() + to));
    band.upper.push_back(unit * *std::max_element(measured->maximum.begin() + from, measured->maximum.begin() + to));
    mean.x.push_back(t);
    mean.y.push_back(unit * sum / static_cast<double>(merged));
  }
  panel.bands.push_back(std::move(band));
  panel.curves.push_back(std::move(mean));
}

std::string axis_name(const std::string& sensor, SensorKind kind) {
  return kind == SensorKind::pressure ? "pressure at " + sensor + " [kPa]" : "water height at " + sensor + " [m]";
}

/// Which runs leave a panel through its top, in words for the caption.
struct Cut {
  double limit = 0;
  std::string words;
};

void note_cut(Cut& cut, const AnalysedRun& run, const PlotCurve& curve) {
  const auto top = std::max_element(curve.y.begin(), curve.y.end());
  if (cut.limit <= 0 || top == curve.y.end() || *top <= cut.limit) return;
  cut.words += fmt::format("{}{} {:.1f} kPa at {:.3f} s", cut.words.empty() ? "" : ", ", run.key, *top,
                           curve.x[static_cast<std::size_t>(top - curve.y.begin())]);
}

/// Panels of one sensor, one a group of runs; empty when no run has the reading.
std::vector<PlotPanel> sensor_panels(const ReportData& data, const std::string& sensor, SensorKind kind,
                                     const std::string& model, Window window, bool smoothed, Cut& cut) {
  std::vector<PlotPanel> panels;
  for (const RunGroup& group : run_groups(data, runs_a_panel)) {
    PlotPanel panel;
    panel.x_label = "time [s]";
    panel.y_label = axis_name(sensor, kind);
    panel.x_range = {window.begin_s, window.end_s};
    add_experiment(panel, data.measured_series(sensor), window, drawn_unit(kind));
    int style = 0;
    std::string models;
    for (const AnalysedRun* run : group.runs) {
      const int own_style = style++;
      const SensorReading* reading = reading_of(*run, sensor, model);
      if (reading == nullptr || reading->series.t_s.empty()) continue;
      models = reading->model.empty() ? "as delivered" : "read by " + reading->model;
      panel.curves.push_back(run_curve(*run, smoothed ? running_mean(reading->series, smoothing_s) : reading->series,
                                       window, own_style, drawn_unit(kind)));
      note_cut(cut, *run, panel.curves.back());
    }
    panel.title = fmt::format("{}: {}{}", sensor, group.title, models.empty() ? "" : ", " + models);
    if (!models.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

std::string run_keys(const ReportData& data) {
  std::string keys;
  for (const AnalysedRun& run : data.runs) keys += (keys.empty() ? "" : ", ") + run.label;
  return keys;
}

Picture make_picture(const FigureMaker& maker, const std::string& name, std::vector<PlotPanel> panels,
                     const std::string& caption, const std::string& description) {
  PlotFigure figure;
  figure.name = name;
  figure.panels = std::move(panels);
  figure.source = run_keys(maker.data);
  return draw_picture(maker, figure, caption, description);
}

/// 1.5 times the measured peak [kPa]; zero where nothing was measured.
double pressure_limit(const ReportData& data, const std::string& sensor) {
  const MeasuredSeries* measured = data.measured_series(sensor);
  if (measured == nullptr || measured->maximum.empty()) return 0;
  return 1e-3 * headroom * *std::max_element(measured->maximum.begin(), measured->maximum.end());
}

/// Panels of one sensor over one range, so that groups of runs can be compared by eye.
void share_range(std::vector<PlotPanel>& panels, const Cut& cut) {
  double low = 1e300;
  double high = -1e300;
  for (const PlotPanel& panel : panels)
    for (const PlotCurve& curve : panel.curves)
      for (double y : curve.y) {
        low = std::min(low, y);
        high = std::max(high, y);
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

std::vector<Picture> series_figures(const FigureMaker& maker, SensorKind kind) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  const bool pressure = kind == SensorKind::pressure;
  for (const std::string& sensor : data.sensors(kind)) {
    Cut cut{pressure ? pressure_limit(data, sensor) : 0, ""};
    auto panels = sensor_panels(data, sensor, kind, "", data.window, pressure, cut);
    if (panels.empty()) continue;
    share_range(panels, cut);
    std::string caption =
        pressure ? fmt::format("Pressure at {}{}: runs after a 10 ms running mean, primary reading.", sensor,
                               paper_remark(data, sensor))
                 : fmt::format("Water height at {}{}: primary reading.", sensor, paper_remark(data, sensor));
    if (!cut.words.empty())
      caption += fmt::format(" The axis ends at {:.1f} kPa; beyond it: {}.", cut.limit, cut.words);
    pictures.push_back(make_picture(maker, (pressure ? "pressure_" : "wave_") + sensor, std::move(panels), caption,
                                    fmt::format("{} over time, experiment and runs", axis_name(sensor, kind))));
  }
  return pictures;
}

std::vector<Picture> spray_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  for (const std::string& sensor : maker.data.sensors(SensorKind::wave_height)) {
    Cut none;
    auto panels = sensor_panels(maker.data, sensor, SensorKind::wave_height, "top", maker.data.window, false, none);
    if (panels.empty()) continue;
    pictures.push_back(make_picture(maker, "wave_" + sensor + "_top", std::move(panels),
                                    fmt::format("Highest water on the line of {}, spray included (model top).", sensor),
                                    fmt::format("Highest water at {} over time, experiment and runs", sensor)));
  }
  return pictures;
}

std::vector<Picture> impact_figures(const FigureMaker& maker) {
  std::vector<Picture> pictures;
  if (!maker.enabled) return pictures;
  const ReportData& data = maker.data;
  for (const std::string& sensor : data.sensors(SensorKind::pressure)) {
    std::optional<double> arrival;
    if (const MeasuredSeries* measured = data.measured_series(sensor))
      arrival = arrival_at_fraction_of_peak(*measured, data.window);
    for (const AnalysedRun& run : data.runs)
      if (const SensorReading* reading = run.primary(sensor); reading != nullptr && !arrival)
        arrival = reading->comparison.arrival_s.simulated;
    if (!arrival) continue;
    const Window window = impact_window(data, sensor, *arrival);
    Cut none;
    auto panels = sensor_panels(data, sensor, SensorKind::pressure, "", window, false, none);
    if (panels.empty()) continue;
    pictures.push_back(make_picture(maker, "impact_" + sensor, std::move(panels),
                                    fmt::format("First impact at {}: raw readings, nothing cut.", sensor),
                                    fmt::format("Pressure at {} around the first impact", sensor)));
  }
  return pictures;
}

}  // namespace sluice
