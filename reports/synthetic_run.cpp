#include "reports/synthetic_run.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "solvers/snapshot.h"
#include "validation/case.h"
#include "validation/manifest.h"
#include "validation/measurements.h"
#include "validation/series.h"

namespace sluice::synthetic {

namespace {

using nlohmann::json;

constexpr double pi = 3.14159265358979323846;

/// The measured bin means, straight between bin centres and flat beyond the ends.
double measured_at(const MeasuredSeries& series, double t) {
  if (t <= series.t_s.front()) return series.mean.front();
  if (t >= series.t_s.back()) return series.mean.back();
  const double at = (t - series.t_s.front()) / series.bin_s;
  const auto i = std::min(static_cast<std::size_t>(at), series.t_s.size() - 2);
  return series.mean[i] + (at - static_cast<double>(i)) * (series.mean[i + 1] - series.mean[i]);
}

std::vector<double> times(double t_end_s) {
  std::vector<double> t;
  for (int k = 0; k <= std::lround(1000 * t_end_s); ++k) t.push_back(0.001 * k);
  return t;
}

std::vector<double> curve(const MeasuredSeries& series, const std::vector<double>& t, double scale,
                          const MadeRun& run) {
  std::vector<double> values;
  for (double time : t) {
    const double tone = series.unit == "Pa" ? run.noise_Pa * std::sin(2 * pi * 90 * time) : 0.0;
    values.push_back(scale * measured_at(series, time - run.shift_s) + tone);
  }
  return values;
}

json manifest_of(const MadeRun& run, const Case& c) {
  const std::string primary = run.walls == "dynamic" ? "kernel" : "wall";
  json sensors;
  for (const CaseSensor& sensor : c.sensors)
    sensors[sensor.name] = {{"primary", sensor.kind == SensorKind::pressure ? primary : "column"}};
  return {{"schema", 1},
          {"case", "kleefsman"},
          {"solver", run.solver},
          {"walls", run.walls},
          {"l0_m", run.l0_m},
          {"alpha", run.alpha},
          {"equivalent_viscosity_m2_s", 6.97 * run.alpha * run.l0_m},
          {"t_end_s", 6.0},
          {"time_s", run.t_end_s},
          {"threads", 2},
          {"steps", 60000},
          {"dt_mean_s", 1e-4},
          {"particles", {{"fluid", 84000}, {"solid", 31000}}},
          {"lost", {{"through_walls", run.walls == "dynamic" ? 12 : 0}, {"over_top", 7}}},
          {"fluid_volume", {{"nominal_m3", 0.6754}, {"fitted_m3", 0.6720}, {"deviation", -0.005}}},
          {"wall_time_s", 900 * std::pow(0.02 / run.l0_m, 4)},
          {"particle_steps_per_s", 5.6e6},
          {"phases", {{"sums", 700.0}, {"sort", 100.0}, {"sensors", 100.0}}},
          {"peak_memory_bytes", 2.1e7},
          {"commit", "0123abcd"},
          {"compiler", "g++ 12.2.0"},
          {"flags", "-O3"},
          {"cpu", "a processor"},
          {"machine", "a machine"},
          {"parameters", {{"kernel_radius_over_distance", 3.0}, {"delta", 0.1}}},
          {"sensors", sensors},
          {"case_hash", c.hash},
          {"warnings", json::array()},
          {"status", run.status}};
}

}  // namespace

void write_run(const std::filesystem::path& directory, const MadeRun& run) {
  const Case c = load_case("kleefsman");
  const MeasuredData measured = MeasuredData::load(resolve_in_source_tree(c.measured));
  const std::vector<double> t = times(run.t_end_s);
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  auto add = [&](const std::string& name, std::vector<double> values) {
    names.push_back(name);
    columns.push_back(std::move(values));
  };
  for (const CaseSensor& sensor : c.sensors) {
    const MeasuredSeries& series = measured.series(sensor.measured);
    const auto own = curve(series, t, run.scale, run);
    add(probe_column(sensor), own);
    if (sensor.kind == SensorKind::wave_height) {
      add(probe_column(sensor, "column"), own);
      add(probe_column(sensor, "top"), curve(series, t, 1.1 * run.scale, run));
      continue;
    }
    const auto other = curve(series, t, run.second_scale, run);
    const bool dynamic = run.walls == "dynamic";
    add(probe_column(sensor, "wall"), dynamic ? other : own);
    add(probe_column(sensor, "kernel"), dynamic ? own : other);
    add(sensor.name + "_kernel_support_1", std::vector<double>(t.size(), 0.8));
  }
  std::vector<double> kinetic(t.size(), 100);
  std::vector<double> ratio(t.size(), 1.01);
  if (!t.empty()) kinetic.back() = 90;
  if (t.size() > 2) kinetic[t.size() / 2] = 110;  // a scheme that adds energy
  if (t.size() > 1) ratio[1] = 1.3;               // before one second
  add("kinetic_energy_J", std::move(kinetic));
  add("potential_energy_J", std::vector<double>(t.size(), 900));
  add("greatest_density_ratio_1", std::move(ratio));
  std::filesystem::create_directories(directory);
  write_probes(directory / "probes.csv", ProbeTable(directory / "probes.csv", names, t, columns));
  write_manifest(directory, manifest_of(run, c));
}

namespace {

double pulse_N(double t) {
  return std::max(0.0, 10 * (1 - std::abs(t - 0.6) / 0.1));
}

std::vector<double> force_curve(const MeasuredSeries* measured, const std::vector<double>& t, double scale,
                                const MadeForceRun& run, double noise) {
  std::vector<double> values;
  for (double time : t) {
    const double at = time - run.shift_s;
    values.push_back(scale * (measured != nullptr ? measured_at(*measured, at) : pulse_N(at)) +
                     noise * std::sin(2 * pi * 90 * time));
  }
  return values;
}

json force_manifest(const MadeForceRun& run, const Case& c, double t_end_s) {
  json manifest = manifest_of({}, c);
  manifest.update({{"case", run.case_name},
                   {"solver", run.solver},
                   {"walls", run.walls},
                   {"l0_m", run.l0_m},
                   {"alpha", run.alpha},
                   {"t_end_s", t_end_s},
                   {"time_s", t_end_s},
                   {"lost", {{"through_walls", 0}, {"over_top", 0}}}});
  if (run.solver == "mps") manifest.erase("alpha");
  for (const auto& [name, value] : run.parameters) manifest["parameters"][name] = value;
  for (const CaseSensor& sensor : c.sensors)
    manifest["sensors"][sensor.name] = {{"primary", primary_model(c, sensor, run.solver, run.walls)}};
  return manifest;
}

}  // namespace

void write_force_run(const std::filesystem::path& directory, const MadeForceRun& run) {
  const Case c = load_case(run.case_name);
  const Measurements measured = Measurements::load(c);
  const std::vector<double> t = times(c.t_end_s);
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  for (const CaseSensor& sensor : c.sensors) {
    const std::string primary = primary_model(c, sensor, run.solver, run.walls);
    const double noise = sensor.kind == SensorKind::force ? run.noise_N : 0;
    for (const std::string& model : models_of(sensor.kind)) {
      const double scale = model == primary ? run.scale : run.second_scale;
      columns.push_back(force_curve(measured.find(sensor.name), t, scale, run, noise));
      names.push_back(probe_column(sensor, model));
      if (model != primary) continue;
      columns.push_back(columns.back());
      names.push_back(probe_column(sensor));
    }
  }
  std::filesystem::create_directories(directory);
  write_probes(directory / "probes.csv", ProbeTable(directory / "probes.csv", names, t, columns));
  write_manifest(directory, force_manifest(run, c, c.t_end_s));
}

void write_external_run(const std::filesystem::path& directory, double scale) {
  const Case c = load_case("kleefsman");
  const MeasuredData measured = MeasuredData::load(resolve_in_source_tree(c.measured));
  MadeRun like;
  const std::vector<double> t = times(6.0);
  std::filesystem::create_directories(directory);
  write_probes(directory / "probes.csv", ProbeTable(directory / "probes.csv", {"P1_Pa", "H2_m"}, t,
                                                    {curve(measured.series("P1"), t, scale, like),
                                                     curve(measured.series("H2"), t, scale, like)}));
  std::ofstream(directory / "run.json") << "{ \"case\": \"kleefsman\",\n  \"solver\": \"interFoam & <friends>\",\n"
                                           "  \"l0_m\": 0.02 }\n";
}

void write_snapshots(const std::filesystem::path& directory, const std::vector<double>& times_s, double l0_m,
                     const std::string& case_name) {
  const Case c = load_case(case_name);
  ParticleSnapshot snapshot;
  for (const Box& box : c.fluid)
    for (double z = box.lower.z + 0.5 * l0_m; z < box.upper.z; z += l0_m)
      for (double y = box.lower.y + 0.5 * l0_m; y < box.upper.y; y += l0_m)
        for (double x = box.lower.x + 0.5 * l0_m; x < box.upper.x; x += l0_m) {
          snapshot.position_m.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
          snapshot.pressure_Pa.push_back(static_cast<float>(9810 * (c.water_height_m - z)));
        }
  snapshot.fluid_count = snapshot.position_m.size();
  snapshot.velocity_m_s.resize(snapshot.fluid_count);
  snapshot.density_kg_m3.resize(snapshot.fluid_count, 1000.0f);
  for (std::size_t i = 0; i < snapshot.fluid_count; ++i) snapshot.id.push_back(static_cast<std::int32_t>(i));
  SnapshotWriter writer(directory);
  for (double time : times_s) {
    snapshot.time_s = time;
    writer.write(snapshot);
  }
}

}  // namespace sluice::synthetic
