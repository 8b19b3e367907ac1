// Another code, or one of ours, behind a program that runs one case and writes a run directory: bench/peers/README.md
// describes what such a program must do.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sluice::bench {

struct Peer {
  std::string name;  ///< the program's file name
  std::filesystem::path program;
};

/// A program in `folder` by its name, or anywhere by its path (with a slash in it). Throws std::runtime_error naming
/// what there is.
Peer find_peer(const std::string& name_or_path, const std::filesystem::path& folder);

/// What all peers are asked to run.
struct PeerTask {
  std::string case_name = "kleefsman";
  double l0_m = 0.04;
  double t_end_s = 0.1;
  int threads = 1;
};

/// What one run cost; times are of its time steps alone.
struct PeerRun {
  std::string solver;
  bool own = false;  ///< of this project
  double fluid_particles = 0;
  double steps = 0;
  double simulated_s = 0;
  double particle_steps_per_s = 0;

  double ns_per_particle_step() const { return 1e9 / particle_steps_per_s; }
  double wall_s_per_simulated_s() const { return steps * fluid_particles / (particle_steps_per_s * simulated_s); }
};

/// Why the peer cannot run here; nullopt when it can. Throws std::runtime_error when its program does not keep to the
/// protocol.
std::optional<std::string> why_missing(const Peer& peer, const std::filesystem::path& log);

/// Runs a peer into a directory and reads what it wrote. Throws std::runtime_error naming the program and file and what
/// is wrong with it.
PeerRun run_peer(const Peer& peer, const PeerTask& task, const std::filesystem::path& directory);

/// One peer's runs, in the order in which they were made.
struct PeerRuns {
  Peer peer;
  std::vector<PeerRun> runs;
};

double median(std::vector<double> values);

/// A table, a line a peer: median, least and greatest time, and how many times that of the first.
std::string describe(const std::vector<PeerRuns>& all);

/// The same in Google Benchmark's form: names are `wcsph/peers/...` and `mps/peers/...` for our solvers and
/// `peers/NAME/...` for others.
nlohmann::json to_benchmark_json(const std::vector<PeerRuns>& all, const PeerTask& task);

}  // namespace sluice::bench
