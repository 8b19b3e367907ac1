#include "validation/run_manifest.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/manifest.h"
#include "validation/measurements.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

using nlohmann::json;

json to_json(const Vec3d& v) {
  return json::array({v.x, v.y, v.z});
}

// Lattice volumes that differ by more than this are worth a warning: the design's bound at the paper's resolutions.
constexpr double volume_tolerance = 0.01;

void put_provenance(json& m, const Case& c) {
  m["commit"] = build_info().commit;
  m["version"] = build_info().version;
  m["compiler"] = build_info().compiler;
  m["flags"] = build_info().flags;
  m["cpu"] = cpu_model();
  m["machine"] = machine_fingerprint();
  m["started"] = utc_now();
  m["case_hash"] = c.hash;
  m["computed_hash"] = c.computed_hash;
  m["data_hash"] = nullptr;
  for (const MeasuredFile& file : measured_files(c)) {
    if (!file.present())
      m["warnings"].push_back(fmt::format("measured data missing: {}", file.path.generic_string()));
    else if (file.path == c.measured)
      m["data_hash"] = file.hash;
    else
      m["other_data_hashes"][file.path.generic_string()] = file.hash;
  }
}

void put_scene(json& m, const Scene& scene) {
  m["fitted_lengths"] = json::array();
  for (const FittedLength& f : scene.fitted_lengths)
    m["fitted_lengths"].push_back({{"name", f.name}, {"nominal_m", f.nominal_m}, {"fitted_m", f.fitted_m}});
  const double nominal = scene.nominal_fluid_volume_m3;
  const double deviation = (scene.fluid_volume_m3 - nominal) / nominal;
  m["fluid_volume"] = {{"nominal_m3", nominal}, {"fitted_m3", scene.fluid_volume_m3}, {"deviation", deviation}};
  if (std::abs(deviation) > volume_tolerance)
    m["warnings"].push_back(
        fmt::format("the fluid's volume on the lattice deviates by {:+.1f} % from the nominal", 100 * deviation));
  m["particles"] = {{"fluid", scene.fluid.size()}, {"solid", scene.walls.size()}};
}

void put_sensors(json& m, const std::vector<PlacedSensor>& sensors) {
  m["sensors"] = json::object();
  for (const PlacedSensor& s : sensors)
    m["sensors"][s.name] = {{"kind", s.kind},
                            {"primary", s.primary},
                            {"position_m", to_json(s.position_m)},
                            {"placed_m", to_json(s.placed_m)},
                            {"offset_m", s.offset_m}};
}

}  // namespace

json asked_manifest(const Case& c, const RunSettings& settings) {
  json m;
  m["schema"] = manifest_schema;
  m["case"] = c.name;
  if (const std::string file = outside_case_file(c); !file.empty()) m["case_file"] = file;
  m["solver"] = settings.solver;
  m["walls"] = settings.walls;
  m["l0_m"] = settings.l0_m;
  if (const auto alpha = settings.parameters.find("alpha"); alpha != settings.parameters.end())
    m["alpha"] = alpha->second;
  if (const auto viscosity = equivalent_viscosity_m2_s(settings)) m["equivalent_viscosity_m2_s"] = *viscosity;
  m["t_end_s"] = settings.t_end_s;
  m["output_rate_Hz"] = settings.output_rate_Hz;
  m["threads"] = settings.threads;
  m["snapshot_times_s"] = settings.snapshot_times_s;
  m["parameters"] = settings.parameters;
  m["warnings"] = json::array();
  m["status"] = "running";
  m["error"] = "";
  put_provenance(m, c);
  return m;
}

json start_manifest(const Case& c, const RunSettings& settings, const Scene& scene,
                    const std::vector<PlacedSensor>& sensors) {
  json m = asked_manifest(c, settings);
  put_scene(m, scene);
  put_sensors(m, sensors);
  return m;
}

void update_manifest(json& m, const Solver& solver, const RunTally& tally) {
  const auto steps = solver.steps();
  m["time_s"] = solver.time_s();
  m["steps"] = steps;
  if (steps > 0) {
    m["dt_mean_s"] = solver.time_s() / static_cast<double>(steps);
    m["dt_min_s"] = tally.dt_min_s;
    m["dt_max_s"] = tally.dt_max_s;
  }
  m["lost"] = {{"through_walls", solver.lost().through_walls}, {"over_top", solver.lost().over_top}};
  m["wall_time_s"] = tally.wall_s;
  m["cpu_time_s"] = tally.cpu_s;
  // Whole time steps: sums, sort and stepping, and the sensors with them.
  const double stepping_s = tally.stepping_s + tally.sensors_s;
  m["particle_steps_per_s"] = stepping_s > 0 ? tally.particle_steps / stepping_s : 0.0;
  PhaseTimes phases = tally.earlier_phases;
  for (const auto& [phase, time_s] : solver.phases()) phases[phase] += time_s;
  m["phases"] = phases;
  m["phases"]["sensors"] = tally.sensors_s;
  m["phases"]["output"] = tally.output_s;
  m["peak_memory_bytes"] = peak_memory_bytes();
  const auto particles = solver.fluid_count() + solver.solid_count();
  if (particles > 0)
    m["bytes_per_particle"] = static_cast<double>(solver.memory_bytes()) / static_cast<double>(particles);
  m["facts"] = solver.facts();
}

}  // namespace sluice
