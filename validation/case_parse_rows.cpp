// The rows of a case file that results are held against: acceptance bands, and the values that the paper printed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/case_parse.h"
#include "validation/suggest.h"

namespace sluice::case_parse {
namespace {

const AcceptanceMetric* find_metric(std::string_view name) {
  for (const AcceptanceMetric& metric : acceptance_metrics())
    if (metric.name == name) return &metric;
  return nullptr;
}

void parse_band(TomlReader& reader, AcceptanceRow& row) {
  const bool symmetric = reader.has("within");
  const bool one_sided = reader.has("lower") || reader.has("upper");
  if (symmetric == one_sided)
    reader.fail("", "must have either `within` (a symmetric band) or `lower` and `upper` (one or both)");
  if (symmetric) {
    row.upper = reader.positive_number("within");
    row.lower = -row.upper;
    return;
  }
  row.lower = reader.number_or("lower", -HUGE_VAL);
  row.upper = reader.number_or("upper", HUGE_VAL);
  if (row.lower > row.upper) reader.fail("lower", "lies above `upper`: nothing could pass (exchange them)");
}

void check_row_model(const TomlReader& reader, const AcceptanceRow& row, SensorKind kind) {
  const std::vector<std::string>& models = models_of(kind);
  if (!row.model.empty() && std::find(models.begin(), models.end(), row.model) == models.end())
    reader.fail("model", fmt::format("`{}` cannot read a {} sensor{}", row.model, to_string(kind),
                                     suggestion(row.model, models)));
}

AcceptanceRow parse_acceptance_row(TomlReader& reader, AcceptanceRow row, const Case& c) {
  row.line = reader.line();
  row.metric = reader.text("metric");
  const AcceptanceMetric* metric = find_metric(row.metric);
  if (metric == nullptr)
    reader.fail("metric", fmt::format("unknown metric `{}`{}", row.metric,
                                      suggestion(row.metric, names_of(acceptance_metrics()))));
  if (metric->needs_sensor) {
    row.sensor = one_of(reader, "sensor", names_of(c.sensors));
    row.model = reader.text_or("model", "");
    const CaseSensor& sensor = *c.find_sensor(row.sensor);
    check_row_model(reader, row, sensor.kind);
    if (sensor.measured.empty()) reader.fail("sensor", "has no measured series (there is nothing to compare with)");
    if (reader.has("window_s")) row.window = parse_window(reader, "window_s");
    if (row.metric == "share_inside_band" && !sensor.measured_is_band)
      reader.fail("metric", fmt::format("needs a band, and that of {} is the spread within the bins of one recording "
                                        "(say measured_is_band = true at the sensor if it is a real one)",
                                        row.sensor));
  }
  row.remark = reader.text_or("remark", "");
  parse_band(reader, row);
  reader.finish();
  return row;
}

/// The rest of a group: its alpha and its rows.
void add_rows(TomlReader& reader, AcceptanceRow common, Case& c) {
  common.alpha = reader.optional_number("alpha");
  for (TomlReader& row : reader.tables("rows")) c.acceptance.push_back(parse_acceptance_row(row, common, c));
  reader.finish();
}

/// A group of a file of bands, for any solver.
void parse_bands_group(TomlReader& reader, const std::string& file, Case& c) {
  AcceptanceRow common;
  common.file = file;
  common.solver = reader.text("solver");
  common.walls = reader.text_or("walls", "");
  common.l0_max_m = HUGE_VAL;
  if (reader.has("l0_m")) std::tie(common.l0_min_m, common.l0_max_m) = reader.range("l0_m");
  add_rows(reader, common, c);
}

PublishedImpulse parse_published_impulse(TomlReader& reader, const Case& c) {
  PublishedImpulse p;
  p.sensor = one_of(reader, "sensor", names_of(c.sensors));
  p.source = reader.text("source");
  p.alpha = reader.optional_number("alpha");
  p.impulse_Pa_s = reader.number("impulse_Pa_s");
  p.deviation_percent = reader.optional_number("deviation_percent");
  reader.finish();
  return p;
}

PublishedRun parse_published_run(TomlReader& reader) {
  PublishedRun run;
  run.solver = reader.text("solver");
  run.l0_m = reader.positive_number("l0_m");
  run.radius_over_l0 = reader.positive_number("radius_over_l0");
  if (reader.has("alpha")) run.alpha = reader.numbers("alpha");
  run.viscosity_m2_s = reader.numbers("viscosity_m2_s");
  if (!run.alpha.empty() && run.alpha.size() != run.viscosity_m2_s.size())
    reader.fail("viscosity_m2_s", "must have as many values as alpha");
  run.fluid_particles = reader.positive_number("fluid_particles");
  run.solid_particles = reader.positive_number("solid_particles");
  run.t_end_s = reader.positive_number("t_end_s");
  run.dt_s = reader.positive_number("dt_s");
  run.cpu_time_s = reader.positive_number("cpu_time_s");
  run.gpu_time_s = reader.optional_number("gpu_time_s");
  run.remark = reader.text_or("remark", "");
  reader.finish();
  return run;
}

}  // namespace

std::string one_of(TomlReader& reader, std::string_view key, const std::vector<std::string>& choices) {
  std::string value = reader.text(key);
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    reader.fail(key, fmt::format("unknown value `{}`{}", value, suggestion(value, choices)));
  return value;
}

TimeWindow parse_window(TomlReader& reader, std::string_view key) {
  TimeWindow window;
  std::tie(window.start_s, window.end_s) = reader.range(key);
  if (window.start_s < 0 || window.start_s == window.end_s)
    reader.fail(key, "must be a span of time that does not start before 0");
  return window;
}

std::vector<TimeWindow> parse_windows(TomlReader& reader, std::string_view key) {
  std::vector<TimeWindow> windows;
  if (!reader.has(key)) return windows;
  for (const auto& [start_s, end_s] : reader.ranges(key)) windows.push_back({start_s, end_s});
  for (const TimeWindow& window : windows)
    if (window.start_s < 0 || window.start_s == window.end_s)
      reader.fail(key, "must hold spans of time that do not start before 0, such as [[0.3, 1.3]]");
  return windows;
}

void parse_acceptance_group(TomlReader& reader, Case& c) {
  AcceptanceRow common;
  common.solver = one_of(reader, "solver", names_of(c.solvers));
  if (reader.has("walls")) common.walls = one_of(reader, "walls", names_of(c.find_solver(common.solver)->walls));
  std::tie(common.l0_min_m, common.l0_max_m) = reader.range("l0_m");
  add_rows(reader, common, c);
}

void parse_published(TomlReader reader, Case& c) {
  Published& p = c.published;
  p.reference = reader.text("reference");
  p.cpu = reader.text_or("cpu", "");
  p.gpu = reader.text_or("gpu", "");
  if (reader.has("impulses_table")) p.impulses_table = reader.integer("impulses_table");
  if (reader.has("runs_table")) p.runs_table = reader.integer("runs_table");
  if (reader.has("snapshots_figure")) p.snapshots_figure = reader.integer("snapshots_figure");
  p.snapshots_alpha = reader.optional_number("snapshots_alpha");
  p.snapshots_l0_m = reader.optional_number("snapshots_l0_m");
  if (reader.has("snapshots_colour")) p.snapshots_colour = one_of(reader, "snapshots_colour", {"pressure", "velocity"});
  if (reader.has("geometry_figure")) p.geometry_figure = reader.integer("geometry_figure");
  for (TomlReader& impulse : reader.tables("impulses", true)) p.impulses.push_back(parse_published_impulse(impulse, c));
  for (TomlReader& run : reader.tables("runs", true)) p.runs.push_back(parse_published_run(run));
  for (TomlReader& figure : reader.tables("figures", true)) {
    p.figures.push_back({figure.integer("number"), one_of(figure, "sensor", names_of(c.sensors))});
    figure.finish();
  }
  reader.finish();
}

}  // namespace sluice::case_parse

namespace sluice {

void add_bands(Case& c, const std::filesystem::path& file) {
  const std::string name = file.string();
  const toml::table table = parse_toml(read_text(file, "give a TOML file with [[acceptance]] groups"), name);
  TomlReader root(table, name);
  for (TomlReader& group : root.tables("acceptance")) case_parse::parse_bands_group(group, name, c);
  root.finish();
}

}  // namespace sluice
