#include "reports/series_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "reports/quantity.h"
#include "reports/studies.h"

namespace sluice {
namespace {

constexpr double most_bins = 700;

/// Which reading of a run a figure shows: a model, or the primary one when empty.
const SensorReading* reading_of(const AnalysedRun& run, const std::string& sensor, const std::string& model) {
  return model.empty() ? run.primary(sensor) : run.find(sensor, model);
}

/// Neighbouring bins drawn as one, so that a long view holds no more of them than can be told apart.
std::size_t bins_drawn_as_one(const MeasuredSeries& measured, Window window) {
  const double bins = (window.end_s - window.begin_s) / measured.bin_s;
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(bins / most_bins)));
}

/// Where nothing was measured nothing is drawn.
void add_gap(PlotBand& band, PlotCurve& mean, double t) {
  band.x.push_back(t);
  band.lower.push_back(NAN);
  band.upper.push_back(NAN);
  mean.x.push_back(t);
  mean.y.push_back(NAN);
}

/// Once a run, in however many panels it is drawn.
void note_cut(Cut& cut, const AnalysedRun& run, const PlotCurve& curve) {
  const auto top = std::max_element(curve.y.begin(), curve.y.end());
  if (cut.limit <= 0 || top == curve.y.end() || *top <= cut.limit) return;
  const std::string words = fmt::format("{} {:.1f} {} at {:.3f} s", run.key, *top, cut.unit,
                                        curve.x[static_cast<std::size_t>(top - curve.y.begin())]);
  if (cut.words.find(words) == std::string::npos) cut.words += (cut.words.empty() ? "" : ", ") + words;
}

/// The axes of a sensor with its measurement.
PlotPanel panel_of(const ReportData& data, const CaseSensor& sensor, Window window) {
  PlotPanel panel;
  panel.x_label = "time [s]";
  panel.y_label = axis_name(sensor);
  panel.x_range = {window.begin_s, window.end_s};
  add_experiment(panel, data, sensor, window);
  return panel;
}

/// Adds a run's curve and returns the reading that it shows; nullptr where the run has none.
const SensorReading* add_run(PlotPanel& panel, const AnalysedRun& run, const CaseSensor& sensor, const View& view,
                             int style, Cut& cut) {
  const SensorReading* reading = reading_of(run, sensor.name, view.model);
  if (reading == nullptr || reading->series.t_s.empty()) return nullptr;
  panel.curves.push_back(run_curve(run, view.smoothed ? running_mean(reading->series, smoothing_s) : reading->series,
                                   view.window, style, quantity_of(sensor.kind).drawn_scale));
  note_cut(cut, run, panel.curves.back());
  return reading;
}

std::string run_keys(const ReportData& data) {
  std::string keys;
  for (const AnalysedRun& run : data.runs) keys += (keys.empty() ? "" : ", ") + run.label;
  return keys;
}

}  // namespace

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

std::string axis_name(const CaseSensor& sensor) {
  const Quantity& q = quantity_of(sensor.kind);
  return fmt::format("{} {} [{}]", q.what, sensor.name, q.drawn_unit);
}

void add_experiment(PlotPanel& panel, const ReportData& data, const CaseSensor& sensor, Window window) {
  const MeasuredSeries* measured = data.measured_series(sensor.name);
  if (measured == nullptr) return;
  const double unit = quantity_of(sensor.kind).drawn_scale;
  const std::size_t merged = bins_drawn_as_one(*measured, window);
  const double width_s = static_cast<double>(merged) * measured->bin_s;
  PlotBand band{
      fmt::format("experiment, {} in {:g} ms", sensor.measured_is_band ? "band" : "range", 1000 * width_s), {}, {}, {}};
  PlotCurve mean{
      fmt::format("experiment, mean of {:g} ms", 1000 * width_s), {}, {}, CurveLook::experiment, 0, false, false, {}};
  for (std::size_t i = 0; i + merged <= measured->t_s.size(); i += merged) {
    const double t = 0.5 * (measured->t_s[i] + measured->t_s[i + merged - 1]);
    if (t < window.begin_s || t > window.end_s) continue;
    if (merged == 1 && !measured->has_points(i)) {
      add_gap(band, mean, t);
      continue;
    }
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

std::vector<PlotPanel> sensor_panels(const ReportData& data, const CaseSensor& sensor, const View& view, Cut& cut) {
  std::vector<PlotPanel> panels;
  for (const RunGroup& group : run_groups(data, runs_a_panel)) {
    PlotPanel panel = panel_of(data, sensor, view.window);
    int style = 0;
    std::string models;
    for (const AnalysedRun* run : group.runs)
      if (const SensorReading* reading = add_run(panel, *run, sensor, view, style++, cut))
        models = reading->model.empty() ? "as delivered" : "read by " + reading->model;
    panel.title = fmt::format("{}: {}{}", sensor.name, group.title, models.empty() ? "" : ", " + models);
    if (!models.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

std::vector<PlotPanel> shared_panels(const ReportData& data, const std::vector<RunGroup>& groups,
                                     const CaseSensor& sensor, const View& view, Cut& cut) {
  std::vector<PlotPanel> panels;
  for (const RunGroup& group : groups) {
    PlotPanel panel = panel_of(data, sensor, view.window);
    panel.title = fmt::format("{}: {}", sensor.name, group.title);
    const bool all_ours =
        std::all_of(group.runs.begin(), group.runs.end(), [](const AnalysedRun* run) { return run->record.own; });
    Cut with_these = cut;
    std::set<std::string> methods;
    int style = 0;
    for (const AnalysedRun* run : group.runs) {
      const SensorReading* reading = add_run(panel, *run, sensor, view, style++, with_these);
      if (reading == nullptr) continue;
      panel.curves.back().label =
          fmt::format("{}, {}", all_ours ? run->method_label : run->label, reading->model_name());
      methods.insert(run->group);
    }
    if (methods.size() < 2) continue;  // a run may lack this sensor
    cut = with_these;
    panels.push_back(std::move(panel));
  }
  return panels;
}

std::string with_remark(const ReportData& data, const CaseSensor& sensor, const std::string& caption) {
  const std::string remark = data.measured_remark(sensor.name);
  return remark.empty() ? caption : caption + " " + remark;
}

Picture draw_series(const FigureMaker& maker, const std::string& name, std::vector<PlotPanel> panels,
                    const std::string& caption, const std::string& description) {
  PlotFigure figure;
  figure.name = name;
  figure.panels = std::move(panels);
  figure.source = run_keys(maker.data);
  return draw_picture(maker, figure, caption, description);
}

}  // namespace sluice
