// Runs several codes on the same case in turn, round after round, and says what each costs; then puts their series
// through `sluice compare`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/peers/peer.h"
#include "bench/peers/program.h"
#include "validation/manifest.h"

namespace {

namespace fs = std::filesystem;
using namespace sluice::bench;

struct Arguments {
  std::vector<std::string> peers{"sluice-wcsph", "sluice-mps", "pysph"};
  PeerTask task;
  int rounds = 3;
  fs::path out = "build/release/peers";
  fs::path folder = sluice::build_info().source_root / "bench" / "peers";
  fs::path sluice = "build/release/sluice";
  fs::path results;
  bool no_report = false;
};

/// Those that are installed; of the others it says why not.
std::vector<PeerRuns> present(const Arguments& a) {
  std::vector<PeerRuns> found;
  for (const std::string& name : a.peers) {
    const Peer peer = find_peer(name, a.folder);
    for (const PeerRuns& other : found)
      if (other.peer.name == peer.name) throw std::runtime_error(fmt::format("two peers are called {}", peer.name));
    if (const auto why = why_missing(peer, a.out / (peer.name + ".log")))
      fmt::print(stderr, "{}: left out: {}\n", peer.name, *why);
    else
      found.push_back({peer, {}});
  }
  if (found.empty()) throw std::runtime_error("none of the peers is installed (bench/peers/README.md)");
  return found;
}

/// Every second round the other way about, so that none is always the one after the same other.
void run_all(const Arguments& a, std::vector<PeerRuns>& all) {
  for (int round = 0; round < a.rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      PeerRuns& p = all[round % 2 == 0 ? k : all.size() - 1 - k];
      p.runs.push_back(run_peer(p.peer, a.task, a.out / p.peer.name));
      fmt::print(stderr, "round {} of {}: {}: {:.1f} ns a particle and step\n", round + 1, a.rounds, p.peer.name,
                 p.runs.back().ns_per_particle_step());
    }
  }
}

void compare_series(const Arguments& a, const std::vector<PeerRuns>& all) {
  std::vector<std::string> command{a.sluice.string(), "compare"};
  for (const PeerRuns& p : all) command.push_back((a.out / p.peer.name).string());
  for (const std::string& word :
       {std::string("--case"), a.task.case_name, std::string("--out"), (a.out / "report").string()})
    command.push_back(word);
  const fs::path log = a.out / "report.log";
  if (const int code = run_program(command, log); code != 0)
    throw std::runtime_error(fmt::format("sluice compare: exit status {}: {}", code, last_line(log)));
  fmt::print("{}\n", last_line(log));
}

void run(Arguments& a) {
  fs::create_directories(a.out);
  std::vector<PeerRuns> all = present(a);
  run_all(a, all);
  fmt::print("{}", describe(all));
  if (!a.results.empty()) {
    std::ofstream file(a.results);
    file << to_benchmark_json(all, a.task).dump(2) << '\n';
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", a.results.string()));
  }
  if (!a.no_report) compare_series(a, all);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times codes on the same case in turn and compares their series"};
  Arguments a;
  app.add_option("PEER", a.peers, "Programs of bench/peers by name, or any by path; ratios are to the first")
      ->capture_default_str();
  app.add_option("--case", a.task.case_name, "Case")->capture_default_str();
  app.add_option("--l0", a.task.l0_m, "Particle distance [m]")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--t-end", a.task.t_end_s, "Simulated time [s]")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--threads", a.task.threads, "Threads of each")->check(CLI::Range(1, 4096))->capture_default_str();
  app.add_option("--rounds", a.rounds, "Runs of each")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--out", a.out, "Run directories and report go here")->capture_default_str();
  app.add_option("--peers", a.folder, "Where peers are found by name");
  app.add_option("--sluice", a.sluice, "The program that compares")->capture_default_str();
  app.add_option("--benchmark_out", a.results, "Results in Google Benchmark's JSON");
  app.add_flag("--no-report", a.no_report, "Times only");
  CLI11_PARSE(app, argc, argv);
  try {
    run(a);
  } catch (const std::exception& error) {
    fmt::print(stderr, "compare_peers: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
