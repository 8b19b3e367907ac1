// Tables of what was run: parameters, timing, provenance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/fitted_geometry.h"
#include "reports/tables.h"
#include "reports/text.h"

namespace sluice {

namespace {

TableCell whole(std::optional<double> value) {
  if (!value) return missing();
  return {grouped(std::llround(*value)), value, Tone::plain};
}

TableCell power_of_ten(std::optional<double> value, int digits) {
  if (!value) return missing();
  return {scientific(*value, digits), value, Tone::plain};
}

TableCell time_cell(std::optional<double> seconds) {
  if (!seconds) return missing();
  return {duration(*seconds), seconds, Tone::plain};
}

TableCell memory_cell(std::optional<double> count) {
  if (!count) return missing();
  return {bytes(*count), count, Tone::plain};
}

TableCell text_cell(const std::optional<std::string>& text) {
  return text && !text->empty() ? word(*text) : missing();
}

TableCell status_cell(const std::string& status) {
  if (status.empty()) return missing();
  return word(status, status == "finished" ? Tone::good : Tone::bad);
}

std::optional<double> reached_s(const AnalysedRun& run) {
  const std::vector<double>& times = run.record.probes.times_s();
  return times.empty() ? std::nullopt : std::optional<double>(times.back());
}

/// A run that lists its parameters without alpha has none to tell.
TableCell alpha_cell(const RunRecord& record) {
  if (record.alpha() || !record.manifest.contains("parameters")) return typed(record.alpha());
  return not_applicable();
}

}  // namespace

Table runs_table(const ReportData& data) {
  Table table;
  table.name = "runs";
  table.caption = "The runs of this report";
  table.columns = {{"Run", "run", false},
                   {"Directory", "directory", false},
                   {"Status", "status", false},
                   {"Reached [s]", "reached_s"},
                   {"l0 [m]", "l0_m"},
                   {"α", "alpha"},
                   {"Fluid particles", "fluid_particles"},
                   {"Remarks", "remarks", false}};
  for (const AnalysedRun& run : data.runs) {
    std::string remarks;
    for (const std::string& problem : run.problems) remarks += (remarks.empty() ? "" : "; ") + problem;
    table.add({word(run.label), word(run.directory), status_cell(run.record.status()), number(reached_s(run), 2),
               typed(run.record.l0_m), alpha_cell(run.record), whole(run.record.number("particles.fluid")),
               remarks.empty() ? word("none") : word(remarks, Tone::bad)});
  }
  return table;
}

namespace {

/// "5.2·10⁻⁶ … 5.2·10⁻³": what the paper varied, smallest to largest.
template <class Show>
std::string span_of(const std::vector<double>& values, Show show) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? show(*low) : show(*low) + " … " + show(*high);
}

void add_published_run(Table& table, const PublishedRun& run) {
  const double steps = run.t_end_s / run.dt_s;
  const std::string label = "Paper: " + method_name(run.solver);

  const std::string radius = (run.solver == "mps" ? "re = " : "2h = ") + shortest(run.radius_over_l0) + " l0";
  table.add({word(label),
             run.viscosity_m2_s.empty() ? not_applicable()
                                        : word(span_of(run.viscosity_m2_s, [](double v) { return scientific(v, 2); })),
             run.alpha.empty() ? not_applicable() : word(span_of(run.alpha, shortest)),
             typed(run.l0_m),
             word(radius),
             power_of_ten(run.fluid_particles, 2),
             power_of_ten(run.solid_particles, 2),
             number(run.t_end_s, 1),
             power_of_ten(run.dt_s, 2),
             {significant(steps, 2) + "*", steps, Tone::plain},
             time_cell(run.cpu_time_s),
             {significant(run.fluid_particles * steps / run.cpu_time_s, 2) + "*",
              run.fluid_particles * steps / run.cpu_time_s, Tone::plain},
             not_applicable("not printed"),
             not_applicable("not printed")});
}

void add_published_notes(Table& table, const Published& published) {
  if (!published.runs.empty())
    table.notes.push_back(
        fmt::format("The paper's rows are as printed (CPU: {}); * derived here from its printed particle count, time "
                    "step and time. It prints no number of threads, and does not say whether its time is that of the "
                    "clock or summed over the processor's cores. Processing times of different machines do not compare "
                    "as they are: see Provenance for ours.",
                    published.cpu));
  for (const PublishedRun& run : published.runs) {
    const std::string name = fmt::format("The paper's {}, l0 = {:g} mm", method_name(run.solver), 1000 * run.l0_m);
    if (run.gpu_time_s)
      table.notes.push_back(fmt::format("{}, on a GPU ({}): {}.", name, published.gpu, duration(*run.gpu_time_s)));
    if (!run.remark.empty()) table.notes.push_back(fmt::format("{}: {}.", name, run.remark));
  }
}

TableCell support_cell(const RunRecord& record) {
  const auto ratio = record.number("parameters.kernel_radius_over_distance");
  if (ratio) return word("2h = " + shortest(*ratio) + " l0");
  const auto effective = record.number("parameters.effective_radius_over_distance");
  return effective ? word("re = " + shortest(*effective) + " l0") : missing();
}

}  // namespace

Table parameters_table(const ReportData& data) {
  Table table;
  const int number_in_paper = data.the_case.published.runs_table;
  table.name = number_in_paper > 0 ? fmt::format("table{}_parameters", number_in_paper) : "parameters";
  table.caption = "Numerical parameters and processing time";
  if (number_in_paper > 0) table.caption += fmt::format(", after the paper's Table {}", number_in_paper);
  table.columns = {{"Run", "run", false},
                   {"Equivalent viscosity [m²/s]", "equivalent_viscosity_m2_s"},
                   {"α", "alpha"},
                   {"l0 [m]", "l0_m"},
                   {"Support", "support", false},
                   {"Fluid particles", "fluid_particles"},
                   {"Solid particles", "solid_particles"},
                   {"Simulated [s]", "time_s"},
                   {"Mean Δt [s]", "dt_mean_s"},
                   {"Steps", "steps"},
                   {"Wall time", "wall_time_s"},
                   {"Particle-steps/s", "particle_steps_per_s"},
                   {"Peak memory", "peak_memory_bytes"},
                   {"Threads", "threads"}};
  for (const PublishedRun& run : data.the_case.published.runs) add_published_run(table, run);
  for (const AnalysedRun& run : data.runs) {
    const RunRecord& r = run.record;
    const auto simulated = r.number("time_s");
    table.add({word(run.label), power_of_ten(r.number("equivalent_viscosity_m2_s"), 2), alpha_cell(r), typed(r.l0_m),
               support_cell(r), whole(r.number("particles.fluid")), whole(r.number("particles.solid")),
               number(simulated ? simulated : reached_s(run), 2), power_of_ten(r.number("dt_mean_s"), 2),
               whole(r.number("steps")), time_cell(r.number("wall_time_s")),
               rounded(r.number("particle_steps_per_s"), 3), memory_cell(r.number("peak_memory_bytes")),
               whole(r.number("threads"))});
  }
  add_published_notes(table, data.the_case.published);
  return table;
}

Table solver_parameters_table(const ReportData& data) {
  Table table;
  table.name = "solver_parameters";
  table.caption = "Every parameter and fact that the runs recorded";
  table.columns = {{"Name", "name", false}};
  std::set<std::pair<std::string, std::string>> names;
  for (const AnalysedRun& run : data.runs) {
    table.columns.push_back({run.key, run.key});
    for (const char* part : {"parameters", "facts"})
      if (run.record.manifest.contains(part) && run.record.manifest.at(part).is_object())
        for (const auto& [name, value] : run.record.manifest.at(part).items()) names.insert({part, name});
  }
  for (const auto& [part, name] : names) {
    std::vector<TableCell> row = {word(name)};
    for (const AnalysedRun& run : data.runs) {
      const auto value = run.record.number(part + "." + name);
      row.push_back(value ? rounded(value, 4) : text_cell(run.record.text(part + "." + name)));
    }
    table.add(std::move(row));
  }
  return table;
}

namespace {

std::vector<std::pair<std::string, double>> phases_of(const AnalysedRun& run) {
  std::vector<std::pair<std::string, double>> phases;
  const auto& manifest = run.record.manifest;
  if (!manifest.contains("phases") || !manifest.at("phases").is_object()) return phases;
  for (const auto& [name, seconds] : manifest.at("phases").items())
    if (seconds.is_number()) phases.emplace_back(name, seconds.get<double>());
  return phases;
}

}  // namespace

Table phases_table(const ReportData& data) {
  Table table;
  table.name = "phases";
  table.caption = "Where the time went: share of each phase in the sum of all phases [%]";
  std::vector<std::string> names;
  for (const AnalysedRun& run : data.runs)
    for (const auto& [name, seconds] : phases_of(run))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  table.columns = {{"Run", "run", false}};
  for (const std::string& name : names) table.columns.push_back({name + " [%]", slug(name) + "_percent"});
  table.columns.push_back({"All phases [s]", "all_phases_s"});
  for (const AnalysedRun& run : data.runs) {
    const auto phases = phases_of(run);
    double total = 0;
    for (const auto& [name, seconds] : phases) total += seconds;
    std::vector<TableCell> row = {word(run.label)};
    for (const std::string& name : names) {
      const auto found = std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.first == name; });
      row.push_back(found == phases.end() || total <= 0 ? missing() : number(100 * found->second / total, 1));
    }
    row.push_back(phases.empty() ? missing() : number(total, 1));
    table.add(std::move(row));
  }
  return table;
}

/// The hash of a run's series and, where they were imported, the files that they are from with theirs.
std::string series_source(const AnalysedRun& run) {
  std::string text = run.series_hash;
  const auto found = run.record.manifest.find("imported_from");
  if (found == run.record.manifest.end() || !found->is_array()) return text;
  std::string files;
  for (const nlohmann::json& source : *found)
    if (source.is_object() && source.value("file", nlohmann::json()).is_string() &&
        source.value("hash", nlohmann::json()).is_string())
      files += fmt::format("{}{} {}", files.empty() ? "" : ", ", source["file"].get<std::string>(),
                           source["hash"].get<std::string>());
  return files.empty() ? text : fmt::format("{} (from {})", text, files);
}

/// The hash of the case's measured file when the run was made, and those of further files by their paths.
std::string measured_hashes(const RunRecord& run) {
  std::string text = run.text("data_hash").value_or("");
  const auto others = run.manifest.find("other_data_hashes");
  if (others == run.manifest.end() || !others->is_object()) return text;
  for (const auto& [path, hash] : others->items())
    if (hash.is_string()) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", hash.get<std::string>(), path);
  return text;
}

Table provenance_table(const ReportData& data) {
  Table table;
  table.name = "provenance";
  table.caption = "Where the numbers come from, run by run";
  table.columns = {{"Run", "run", false},
                   {"Directory", "directory", false},
                   {"Started (UTC)", "started", false},
                   {"Status", "status", false},
                   {"Commit", "commit", false},
                   {"Compiler", "compiler", false},
                   {"Flags", "flags", false},
                   {"Machine", "machine", false},
                   {"Threads", "threads"},
                   {"Wall time", "wall_time_s"},
                   {"CPU time", "cpu_time_s"},
                   {"Case file", "case_hash", false},
                   {"Measured data", "data_hash", false},
                   {"Series", "series", false},
                   {"Lost over the top", "lost_over_top"},
                   {"Lost through walls", "lost_through_walls"}};
  for (const AnalysedRun& run : data.runs) {
    const RunRecord& r = run.record;
    TableCell through = whole(r.number("lost.through_walls"));
    if (through.value) through.tone = *through.value > 0 ? Tone::bad : Tone::good;
    table.add({word(run.label), word(run.directory), text_cell(r.text("started")), status_cell(r.status()),
               text_cell(r.text("commit")), text_cell(r.text("compiler")), text_cell(r.text("flags")),
               text_cell(r.text(r.text("machine") ? "machine" : "cpu")), whole(r.number("threads")),
               time_cell(r.number("wall_time_s")), time_cell(r.number("cpu_time_s")), text_cell(r.text("case_hash")),
               text_cell(measured_hashes(r)), run.series_hash.empty() ? missing() : word(series_source(run)),
               whole(r.number("lost.over_top")), through});
  }
  std::string measured;
  for (const MeasuredFile& file : data.measured.files())
    if (file.present()) measured += fmt::format(", {} ({})", file.path.generic_string(), file.hash);
  table.notes.push_back(fmt::format(
      "This report read case file {} ({}){}. A run whose hashes differ was made with other versions of them.",
      data.the_case.name, data.the_case.hash, measured.empty() ? " and no measured data" : measured));
  return table;
}

Table fitted_lengths_table(const ReportData& data) {
  Table table;
  table.name = "fitted_lengths";
  table.caption = "Fluid volume and lengths fitted to the particle lattice";
  table.columns = {{"Run", "run", false},
                   {"Nominal volume [m³]", "nominal_m3"},
                   {"Fitted volume [m³]", "fitted_m3"},
                   {"Deviation [%]", "deviation_percent"},
                   {"Largest change of a length [mm]", "largest_change_mm"},
                   {"of", "length", false}};
  for (const AnalysedRun& run : data.runs) {
    const RunRecord& r = run.record;
    auto deviation = r.number("fluid_volume.deviation");
    std::optional<double> largest;
    std::string name;
    if (const auto lengths = fitted_lengths(r)) {
      largest = 0;
      for (const FittedLength& length : *lengths) {
        const double change = 1000 * (length.fitted_m - length.nominal_m);
        if (std::abs(change) <= std::abs(*largest)) continue;
        largest = change;
        name = length.name;
      }
    }
    if (deviation) *deviation *= 100;
    table.add({word(run.label), number(r.number("fluid_volume.nominal_m3"), 5),
               number(r.number("fluid_volume.fitted_m3"), 5), signed_number(deviation, 2), signed_number(largest, 2),
               name.empty() ? not_applicable() : word(name)});
  }
  return table;
}

}  // namespace sluice
