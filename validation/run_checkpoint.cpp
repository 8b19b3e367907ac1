#include "validation/run_checkpoint.h"

namespace sluice {
namespace {

using nlohmann::json;

json to_json(const RunTally& t) {
  json j{{"wall_s", t.wall_s},       {"stepping_s", t.stepping_s},
         {"sensors_s", t.sensors_s}, {"output_s", t.output_s},
         {"cpu_s", t.cpu_s},         {"particle_steps", t.particle_steps},
         {"dt_max_s", t.dt_max_s},   {"earlier_phases", t.earlier_phases}};
  if (t.dt_max_s > 0) j["dt_min_s"] = t.dt_min_s;  // infinity has no JSON
  return j;
}

RunTally tally_from(const json& j) {
  RunTally t;
  t.wall_s = j.at("wall_s");
  t.stepping_s = j.at("stepping_s");
  t.sensors_s = j.at("sensors_s");
  t.output_s = j.at("output_s");
  t.cpu_s = j.at("cpu_s");
  t.particle_steps = j.at("particle_steps");
  t.dt_max_s = j.at("dt_max_s");
  t.dt_min_s = j.value("dt_min_s", t.dt_min_s);
  t.earlier_phases = j.at("earlier_phases").get<PhaseTimes>();
  return t;
}

json to_json(const RunSettings& s) {
  return {{"solver", s.solver},           {"walls", s.walls},
          {"wall_layers", s.wall_layers}, {"l0_m", s.l0_m},
          {"t_end_s", s.t_end_s},         {"output_rate_Hz", s.output_rate_Hz},
          {"threads", s.threads},         {"snapshot_times_s", s.snapshot_times_s},
          {"parameters", s.parameters}};
}

RunSettings settings_from(const json& j) {
  RunSettings s;
  s.solver = j.at("solver");
  s.walls = j.at("walls");
  s.wall_layers = j.at("wall_layers");
  s.l0_m = j.at("l0_m");
  s.t_end_s = j.at("t_end_s");
  s.output_rate_Hz = j.at("output_rate_Hz");
  s.threads = j.at("threads");
  s.snapshot_times_s = j.at("snapshot_times_s").get<std::vector<double>>();
  s.parameters = j.at("parameters").get<std::map<std::string, double>>();
  return s;
}

/// Of checkpoints that do not tell their legs yet: what is known of the one that began.
json first_leg(const RunHeader& h) {
  return {{"from_s", 0.0}, {"commit", h.commit}, {"threads", h.settings.threads}};
}

}  // namespace

json to_json(const RunHeader& h) {
  const RunPoint& p = h.point;
  return {{"settings", to_json(h.settings)},
          {"case_file", h.case_file},
          {"case_hash", h.case_hash},
          {"computed_hash", h.computed_hash},
          {"commit", h.commit},
          {"tally", to_json(p.tally)},
          {"probes", {{"bytes", p.probes.bytes}, {"rows", p.probes.rows}, {"last_t_s", p.probes.last_t_s}}},
          {"next_sample", p.next_sample},
          {"next_snapshot", p.next_snapshot},
          {"snapshots", p.snapshots},
          {"resumed", p.resumed},
          {"started", p.started},
          {"legs", p.legs},
          {"warnings", p.warnings}};
}

RunHeader run_header_from(const json& j) {
  RunHeader h;
  h.settings = settings_from(j.at("settings"));
  h.case_file = j.at("case_file");
  h.case_hash = j.at("case_hash");
  h.computed_hash = j.value("computed_hash", "");
  h.commit = j.at("commit");
  RunPoint& p = h.point;
  p.tally = tally_from(j.at("tally"));
  const json& probes = j.at("probes");
  p.probes = {probes.at("bytes"), probes.at("rows"), probes.at("last_t_s")};
  p.next_sample = j.at("next_sample");
  p.next_snapshot = j.at("next_snapshot");
  p.snapshots = j.at("snapshots");
  p.resumed = j.at("resumed");
  p.started = j.at("started");
  p.legs = j.value("legs", json::array({first_leg(h)}));
  p.warnings = j.value("warnings", json::array());
  return h;
}

}  // namespace sluice
