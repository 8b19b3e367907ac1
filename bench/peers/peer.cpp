#include "bench/peers/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/peers/program.h"
#include "validation/manifest.h"
#include "validation/run_directory.h"

namespace sluice::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int not_installed = 77;

bool is_program(const fs::path& file) {
  std::error_code ignored;
  const auto bits = fs::status(file, ignored).permissions();
  return fs::is_regular_file(file, ignored) && (bits & fs::perms::owner_exec) != fs::perms::none;
}

double required(const RunRecord& run, const char* key) {
  const std::optional<double> value = run.number(key);
  if (value && *value > 0) return *value;
  throw std::runtime_error(fmt::format("{}: {}: is missing or not a positive number (bench/peers/README.md)",
                                       (run.path / "run.json").string(), key));
}

void check_is_of(const PeerTask& task, const RunRecord& run) {
  const std::string file = (run.path / "run.json").string();
  if (run.case_name != task.case_name)
    throw std::runtime_error(
        fmt::format("{}: case: is `{}`, not the `{}` asked for", file, run.case_name, task.case_name));
  if (std::abs(run.l0_m - task.l0_m) > 1e-9)
    throw std::runtime_error(fmt::format("{}: l0_m: is {}, not the {} asked for", file, run.l0_m, task.l0_m));
}

std::vector<double> ns_per_particle_step(const PeerRuns& p) {
  std::vector<double> times;
  for (const PeerRun& run : p.runs) times.push_back(run.ns_per_particle_step());
  return times;
}

json benchmark_entry(const PeerRuns& p, const PeerTask& task, std::size_t repetition) {
  const PeerRun& run = p.runs[repetition];
  const std::string name = fmt::format("{}/{}/{}/l0:{:g}/threads:{}", run.own ? run.solver + "/peers" : "peers",
                                       p.peer.name, task.case_name, task.l0_m, task.threads);
  const double step_ms = 1e3 * run.fluid_particles / run.particle_steps_per_s;
  return {{"name", name},
          {"run_name", name},
          {"run_type", "iteration"},
          {"repetitions", p.runs.size()},
          {"repetition_index", repetition},
          {"threads", 1},
          {"iterations", run.steps},
          {"real_time", step_ms},
          {"cpu_time", step_ms},
          {"time_unit", "ms"},
          {"items_per_second", run.particle_steps_per_s},
          {"ns_per_particle_step", run.ns_per_particle_step()},
          {"wall_s_per_simulated_s", run.wall_s_per_simulated_s()},
          {"fluid_particles", run.fluid_particles},
          {"omp_threads", task.threads}};
}

/// Removes the run of before, and nothing else that is called so.
void make_way(const fs::path& directory) {
  const bool was_run = fs::exists(directory / "run.json") || fs::exists(directory.string() + ".log");
  if (fs::exists(directory) && !(fs::is_directory(directory) && (was_run || fs::is_empty(directory))))
    throw std::runtime_error(fmt::format(
        "{}: is no run of a peer, and would have to make way for one (choose another --out)", directory.string()));
  fs::remove_all(directory);
  fs::create_directories(directory);
}

}  // namespace

Peer find_peer(const std::string& name_or_path, const fs::path& folder) {
  const bool is_path = name_or_path.find('/') != std::string::npos;
  const fs::path program = is_path ? fs::path(name_or_path) : folder / name_or_path;
  if (is_program(program)) return {program.filename().string(), fs::absolute(program)};
  std::string known;
  if (!is_path && fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_program(entry.path())) known += (known.empty() ? "" : ", ") + entry.path().filename().string();
  throw std::runtime_error(fmt::format("{}: no such program{}", program.string(),
                                       known.empty() ? "" : fmt::format(" (there are {}; or give a path)", known)));
}

std::optional<std::string> why_missing(const Peer& peer, const fs::path& log) {
  const int code = run_program({peer.program.string(), "--check"}, log);
  if (code == 0) return std::nullopt;
  if (code == not_installed) return last_line(log);
  throw std::runtime_error(
      fmt::format("{} --check: exit status {}, where 0 says that the code is installed and {} that it is not: {}",
                  peer.program.string(), code, not_installed, last_line(log)));
}

PeerRun run_peer(const Peer& peer, const PeerTask& task, const fs::path& directory) {
  make_way(directory);
  const fs::path log = directory.string() + ".log";
  const int code = run_program(
      {peer.program.string(), "--case", task.case_name, "--l0", fmt::format("{}", task.l0_m), "--t-end",
       fmt::format("{}", task.t_end_s), "--threads", fmt::format("{}", task.threads), "--out", directory.string()},
      log);
  if (code != 0)
    throw std::runtime_error(fmt::format("{}: exit status {}: {} (all of it in {})", peer.program.string(), code,
                                         last_line(log), log.string()));
  const RunRecord record = read_run(directory);
  check_is_of(task, record);
  PeerRun run;
  run.solver = record.solver;
  run.own = record.own;
  run.fluid_particles = required(record, "particles.fluid");
  run.steps = required(record, "steps");
  run.simulated_s = required(record, "time_s");
  run.particle_steps_per_s = required(record, "particle_steps_per_s");
  return run;
}

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("median of nothing");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

std::string describe(const std::vector<PeerRuns>& all) {
  std::string text = fmt::format("{:16} {:>10} {:>7} {:>10} {:>24} {:>9} {:>12}\n", "peer", "particles", "steps",
                                 "step", "ns a particle and step", "ratio", "s a sim. s");
  const double first = all.empty() ? 1 : median(ns_per_particle_step(all.front()));
  for (const PeerRuns& p : all) {
    const std::vector<double> times = ns_per_particle_step(p);
    const auto [least, greatest] = std::minmax_element(times.begin(), times.end());
    std::vector<double> wall;
    for (const PeerRun& run : p.runs) wall.push_back(run.wall_s_per_simulated_s());
    const PeerRun& run = p.runs.front();
    text += fmt::format("{:16} {:10.0f} {:7.0f} {:7.1f} us {:>24} {:9.2f} {:12.2f}\n", p.peer.name, run.fluid_particles,
                        run.steps, 1e6 * run.simulated_s / run.steps,
                        fmt::format("{:.1f} ({:.1f} to {:.1f})", median(times), *least, *greatest),
                        median(times) / first, median(wall));
  }
  return text;
}

json to_benchmark_json(const std::vector<PeerRuns>& all, const PeerTask& task) {
  json out;
  out["context"] = {{"date", utc_now()},          {"executable", "compare_peers"}, {"library_build_type", "release"},
                    {"cpu", cpu_model()},         {"commit", build_info().commit}, {"compiler", build_info().compiler},
                    {"flags", build_info().flags}};
  out["benchmarks"] = json::array();
  for (const PeerRuns& p : all)
    for (std::size_t k = 0; k < p.runs.size(); ++k) out["benchmarks"].push_back(benchmark_entry(p, task, k));
  return out;
}

}  // namespace sluice::bench
