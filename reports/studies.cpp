#include "reports/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "reports/text.h"

namespace sluice {

namespace {

bool same_alpha(const RunRecord& a, const RunRecord& b) {
  return a.alpha() == b.alpha();
}
bool same_end(const RunRecord& a, const RunRecord& b) {
  return a.number("t_end_s") == b.number("t_end_s");
}

/// What a run was given otherwise than the case has it: neither alpha, nor what its wall model brings with itself, nor
/// the placement `but`.
std::map<std::string, double> changes(const ReportData& data, const RunRecord& run, const Placement* but = nullptr) {
  std::map<std::string, double> changed = changed_parameters(run, data.the_case);
  if (but != nullptr) changed.erase(but->name);
  return changed;
}

/// Whatever makes runs differ in method: changes(), and parameters that the case file does not list.
std::map<std::string, double> method(const ReportData& data, const RunRecord& run, const Placement* but = nullptr) {
  std::map<std::string, double> all = changes(data, run, but);
  const auto given = run.manifest.find("parameters");
  const SolverOption* solver = data.the_case.find_solver(run.solver);
  if (!run.own || solver == nullptr || given == run.manifest.end() || !given->is_object()) return all;
  const WallOption* walls = find_walls(*solver, run.walls);
  for (const auto& [name, value] : solver->parameters)
    if (name != "alpha" && !given->contains(name))
      all["unstated " + name] = value;  // of a time before there was such a parameter
  for (const auto& [name, value] : given->items()) {
    const bool listed = name == "alpha" || solver->parameters.contains(name) ||
                        data.the_case.find_placement(name) != nullptr ||
                        (walls != nullptr && walls->parameters.contains(name));
    if (!listed && value.is_number()) all[name] = value.get<double>();
  }
  return all;
}

/// Sorts runs into lists by a criterion of likeness.
template <class Alike>
std::vector<std::vector<const AnalysedRun*>> group_alike(const ReportData& data, Alike alike) {
  std::vector<std::vector<const AnalysedRun*>> groups;
  for (const AnalysedRun& run : data.runs) {
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& group) { return alike(group.front()->record, run.record); });
    if (found == groups.end())
      groups.push_back({&run});
    else
      found->push_back(&run);
  }
  return groups;
}

}  // namespace

std::vector<std::pair<const AnalysedRun*, const AnalysedRun*>> wall_pairs(const ReportData& data) {
  std::vector<std::pair<const AnalysedRun*, const AnalysedRun*>> pairs;
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    for (std::size_t j = i + 1; j < data.runs.size(); ++j) {
      const RunRecord& a = data.runs[i].record;
      const RunRecord& b = data.runs[j].record;
      if (a.solver == b.solver && a.l0_m == b.l0_m && same_alpha(a, b) && same_end(a, b) && a.walls != b.walls &&
          !a.walls.empty() && !b.walls.empty() && method(data, a) == method(data, b))
        pairs.emplace_back(&data.runs[i], &data.runs[j]);
    }
  return pairs;
}

std::vector<AlphaSeries> alpha_series(const ReportData& data) {
  std::vector<AlphaSeries> out;
  for (auto& runs : group_alike(data, [&](const RunRecord&a, const RunRecord&b) {
         return a.solver == b.solver && a.walls == b.walls && a.l0_m == b.l0_m && same_end(a, b) &&
                method(data, a) == method(data, b);
       })) {
    std::erase_if(runs, [](const AnalysedRun* run) { return !run->record.alpha(); });
    std::stable_sort(runs.begin(), runs.end(),
                     [](auto* a, auto* b) { return *a->record.alpha() < *b->record.alpha(); });
    if (runs.size() < 2 || same_alpha(runs.front()->record, runs.back()->record)) continue;
    out.push_back({fmt::format("{}, l0 = {:g} mm{}", runs.front()->group, 1000 * runs.front()->record.l0_m,
                               parameters_text(changes(data, runs.front()->record))),
                   runs});
  }
  return out;
}

std::vector<ResolutionSeries> resolution_series(const ReportData& data) {
  std::vector<ResolutionSeries> out;
  for (auto& runs : group_alike(data, [&](const RunRecord&a, const RunRecord&b) {
         return a.solver == b.solver && a.walls == b.walls && same_alpha(a, b) && same_end(a, b) &&
                method(data, a) == method(data, b);
       })) {
    std::erase_if(runs, [&](const AnalysedRun* run) { return ended_early(data, *run); });
    std::stable_sort(runs.begin(), runs.end(), [](auto* a, auto* b) { return a->record.l0_m > b->record.l0_m; });
    ResolutionSeries series;
    for (const AnalysedRun* run : runs) {
      const bool new_distance = series.runs.empty() || series.runs.back()->record.l0_m != run->record.l0_m;
      (new_distance ? series.runs : series.left_out).push_back(run);
    }
    if (series.runs.size() < 2) continue;
    const auto alpha = runs.front()->record.alpha();
    series.title = runs.front()->group + (alpha ? fmt::format(", α = {}", shortest(*alpha)) : "") +
                   parameters_text(changes(data, runs.front()->record));
    out.push_back(std::move(series));
  }
  return out;
}

double placed_at_m(const Placement& placement, const RunRecord& run) {
  return run.number("parameters." + placement.name).value_or(placement.drawn_m);
}

std::vector<Obstacle> placed_obstacles(const Case& c, const RunRecord& run) {
  std::vector<Obstacle> obstacles = c.obstacles;
  for (const Placement& placement : c.placements) place(obstacles, placement, placed_at_m(placement, run));
  return obstacles;
}

std::vector<PlacementSeries> placement_series(const ReportData& data) {
  std::vector<PlacementSeries> out;
  for (const Placement& placement : data.the_case.placements)
    for (auto& runs : group_alike(data, [&](const RunRecord&a, const RunRecord&b) {
           return a.solver == b.solver && a.walls == b.walls && a.l0_m == b.l0_m && same_alpha(a, b) &&
                  same_end(a, b) && method(data, a, &placement) == method(data, b, &placement);
         })) {
      std::stable_sort(runs.begin(), runs.end(), [&](auto* a, auto* b) {
        return placed_at_m(placement, a->record) < placed_at_m(placement, b->record);
      });
      if (runs.size() < 2 ||
          placed_at_m(placement, runs.front()->record) == placed_at_m(placement, runs.back()->record))
        continue;
      const auto alpha = runs.front()->record.alpha();
      out.push_back({placement.name,
                     fmt::format("{}, l0 = {:g} mm{}{}", runs.front()->group, 1000 * runs.front()->record.l0_m,
                                 alpha ? fmt::format(", α = {}", shortest(*alpha)) : "",
                                 parameters_text(changes(data, runs.front()->record, &placement))),
                     runs});
    }
  return out;
}

bool same_flow(const ReportData& data, const RunRecord& a, const RunRecord& b) {
  return a.l0_m == b.l0_m && same_end(a, b) &&
         std::all_of(data.the_case.placements.begin(), data.the_case.placements.end(),
                     [&](const Placement& p) { return placed_at_m(p, a) == placed_at_m(p, b); });
}

namespace {

using Runs = std::vector<const AnalysedRun*>;

Runs of_solver(const Runs& runs, const std::string& solver) {
  Runs found;
  for (const AnalysedRun* run : runs)
    if (run->record.solver == solver) found.push_back(run);
  return found;
}

/// Lengths that the case leaves open, where a run has another than as drawn.
std::map<std::string, double> displaced(const ReportData& data, const RunRecord& run) {
  std::map<std::string, double> lengths;
  for (const Placement& placement : data.the_case.placements)
    if (placed_at_m(placement, run) != placement.drawn_m) lengths[placement.name] = placed_at_m(placement, run);
  return lengths;
}

/// Every MPS run meets every WCSPH run in one of the groups.
void add_method_groups(std::vector<RunGroup>& groups, const std::string& title, std::span<const AnalysedRun* const> mps,
                       std::span<const AnalysedRun* const> wcsph, std::size_t limit) {
  for (std::size_t m = 0; m < mps.size(); m += limit - 1) {
    const auto some_mps = mps.subspan(m, std::min(limit - 1, mps.size() - m));
    const std::size_t room = limit - some_mps.size();
    for (std::size_t w = 0; w < wcsph.size(); w += room) {
      const auto some_wcsph = wcsph.subspan(w, std::min(room, wcsph.size() - w));
      RunGroup group{title, Runs(some_mps.begin(), some_mps.end())};
      group.runs.insert(group.runs.end(), some_wcsph.begin(), some_wcsph.end());
      groups.push_back(std::move(group));
    }
  }
}

}  // namespace

std::vector<RunGroup> method_groups(const ReportData& data, std::size_t limit) {
  std::vector<RunGroup> out;
  const auto alike = [&](const RunRecord& a, const RunRecord& b) { return same_flow(data, a, b); };
  for (const Runs& runs : group_alike(data, alike)) {
    const Runs mps = of_solver(runs, "mps");
    const Runs wcsph = of_solver(runs, "wcsph");
    for (auto from = wcsph.begin(); from != wcsph.end();) {  // runs come sorted by their walls
      const AnalysedRun& first = **from;
      const auto to = std::find_if(from, wcsph.end(), [&](const auto* run) { return run->group != first.group; });
      add_method_groups(out,
                        fmt::format("l0 = {:g} mm{}, MPS and {}", 1000 * first.record.l0_m,
                                    parameters_text(displaced(data, first.record)), first.group),
                        mps, {from, to}, std::max<std::size_t>(limit, 2));
      from = to;
    }
  }
  return out;
}

namespace {

/// `model`: of the reading; empty for the primary one.
template <class Measure>
ResolutionQuantity quantity(const std::string& name, int decimals, const ResolutionSeries& series,
                            const std::string& sensor, Measure measure, const std::string& model = "") {
  ResolutionQuantity out{name, decimals, {}, false, model};
  for (const AnalysedRun* run : series.runs) {
    const SensorReading* reading = model.empty() ? run->primary(sensor) : run->find(sensor, model);
    if (reading == nullptr) continue;
    const std::pair<std::optional<double>, std::optional<double>> m = measure(reading->comparison);
    if (m.first && m.second) out.points.push_back({run->record.l0_m, *m.first, *m.second});
  }
  return out;
}

template <class Measure>
ResolutionQuantity value(const std::string& name, int decimals, const ResolutionSeries& series,
                         const std::string& sensor, Measure measure) {
  ResolutionQuantity out = quantity(name, decimals, series, sensor, [&](const Comparison& c) {
    const std::optional<double> v = measure(c);
    return std::pair(v, v);
  });
  out.shows_value = true;
  return out;
}

/// In which a sensor is read beside the primary reading.
std::set<std::string> other_models(const ResolutionSeries& series, const std::string& sensor) {
  std::set<std::string> models;
  for (const AnalysedRun* run : series.runs)
    for (const SensorReading* reading : run->of(sensor))
      if (!reading->primary && !reading->warning_only && !reading->model.empty()) models.insert(reading->model);
  return models;
}

void add_impulses(std::vector<ResolutionQuantity>& out, const ResolutionSeries& series, const std::string& sensor) {
  const auto measure = [](const Comparison& c) {
    return std::pair(c.impulse.simulated, scaled(c.impulse.deviation(), 100));
  };
  out.push_back(quantity(sensor + " impulse [%]", 1, series, sensor, measure));
  for (const std::string& model : other_models(series, sensor))
    out.push_back(quantity(fmt::format("{} impulse, {} [%]", sensor, model), 1, series, sensor, measure, model));
}

}  // namespace

std::vector<ResolutionQuantity> resolution_quantities(const ReportData& data, const ResolutionSeries& series) {
  std::vector<ResolutionQuantity> out;
  for (const std::string& sensor : data.headline_sensors()) add_impulses(out, series, sensor);
  if (!data.headline_sensors().empty()) {
    const std::string first = data.headline_sensors().front();
    out.push_back(quantity(first + " arrival [ms]", 0, series, first, [](const Comparison& c) {
      return std::pair(c.arrival_s.simulated, scaled(c.arrival_s.difference(), 1000));
    }));
  }
  for (const std::string& sensor : data.sensors(SensorKind::wave_height))
    out.push_back(quantity(sensor + " RMSE / range [%]", 1, series, sensor,
                           [](const Comparison& c) { return std::pair(c.rmse, scaled(c.rmse_over_range, 100)); }));
  for (const std::string& sensor : data.sensors(SensorKind::force)) {
    out.push_back(value(sensor + " peak, 10 ms mean [N]", 2, series, sensor,
                        [](const Comparison& c) { return c.smoothed_peak.simulated; }));
    out.push_back(
        value(sensor + " impulse [N s]", 3, series, sensor, [](const Comparison& c) { return c.impulse.simulated; }));
  }
  std::erase_if(out, [](const ResolutionQuantity& q) { return q.points.empty(); });
  return out;
}

std::optional<double> published_deviation(const ReportData& data, const std::string& sensor, const std::string& source,
                                          std::optional<double> alpha) {
  std::optional<double> value;
  std::optional<double> experiment;
  for (const PublishedImpulse& row : data.the_case.published.impulses) {
    if (row.sensor != sensor) continue;
    if (row.source == "experiment") experiment = row.impulse_Pa_s;
    if (row.source == source && row.alpha == alpha) value = row.impulse_Pa_s;
  }
  return relative_deviation(value, experiment);
}

std::optional<double> published_mean(const ReportData& data, const std::string& solver, std::optional<double> alpha) {
  if (data.headline_sensors().empty()) return std::nullopt;
  double sum = 0;
  for (const std::string& sensor : data.headline_sensors()) {
    const auto deviation = published_deviation(data, sensor, solver, alpha);
    if (!deviation) return std::nullopt;
    sum += std::abs(*deviation);
  }
  return sum / static_cast<double>(data.headline_sensors().size());
}

const PublishedRun* published_run(const Case& c, const std::string& solver) {
  for (const PublishedRun& run : c.published.runs)
    if (run.solver == solver) return &run;
  return nullptr;
}

std::string published_distance(const ReportData& data, const std::string& solver) {
  const PublishedRun* run = published_run(data.the_case, solver);
  return run == nullptr ? "" : fmt::format(", l0 = {:g} mm", 1000 * run->l0_m);
}

}  // namespace sluice
