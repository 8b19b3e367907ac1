// The protocol between the driver and its peers, with the stand-in of this folder.
#include "bench/peers/peer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "bench/peers/program.h"

namespace sluice::bench {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Peers : public testing::Test {
 protected:
  Peers() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Peers() override {
    unsetenv("STAND_IN");
    fs::remove_all(folder);
  }
  static void behave(const char* how) { setenv("STAND_IN", how, 1); }
  std::string error_of_run() const {
    try {
      run_peer(stand_in, task, folder / "run");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder = fs::temp_directory_path() / "sluice-peers-test";
  PeerTask task{"kleefsman", 0.05, 0.1, 1};
  Peer stand_in = find_peer("stand-in", "bench/peers");
};

TEST_F(Peers, AreFoundByNameAndByPath) {
  EXPECT_EQ(stand_in.name, "stand-in");
  EXPECT_EQ(find_peer("bench/peers/stand-in", "nowhere").program, stand_in.program);
  try {
    find_peer("stand-inn", "bench/peers");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("bench/peers/stand-inn: no such program"), HasSubstr("stand-in")));
  }
}

TEST_F(Peers, TellWhetherTheyAreInstalled) {
  EXPECT_FALSE(why_missing(stand_in, folder / "log"));
  behave("missing");
  EXPECT_EQ(why_missing(stand_in, folder / "log"), "stand-in: nothing is installed");
  behave("failing");
  EXPECT_THROW(why_missing(stand_in, folder / "log"), std::runtime_error);
}

TEST_F(Peers, WriteARunDirectoryThatSaysWhatItCost) {
  const PeerRun run = run_peer(stand_in, task, folder / "run");
  EXPECT_EQ(run.solver, "stand-in");
  EXPECT_FALSE(run.own);
  EXPECT_EQ(run.fluid_particles, 200);
  EXPECT_EQ(run.steps, 1000);
  EXPECT_DOUBLE_EQ(run.simulated_s, 0.1);
  EXPECT_DOUBLE_EQ(run.ns_per_particle_step(), 2000);
  EXPECT_DOUBLE_EQ(run.wall_s_per_simulated_s(), 4);
}

TEST_F(Peers, OldResultsAreNotTakenForNewOnes) {
  run_peer(stand_in, task, folder / "run");
  std::ofstream(folder / "run" / "old.txt") << "old";
  run_peer(stand_in, task, folder / "run");
  EXPECT_FALSE(fs::exists(folder / "run" / "old.txt"));
}

TEST_F(Peers, NothingElseMakesWayForARun) {
  fs::create_directories(folder / "clone");
  std::ofstream(folder / "clone" / "source.c") << "work";
  std::ofstream(folder / "program") << "work";
  for (const char* name : {"clone", "program"}) {
    EXPECT_THROW(run_peer(stand_in, task, folder / name), std::runtime_error) << name;
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  EXPECT_TRUE(fs::exists(folder / "clone" / "source.c"));
}

TEST_F(Peers, MistakesNameTheProgramOrTheFile) {
  behave("failing");
  EXPECT_THAT(error_of_run(),
              AllOf(HasSubstr("stand-in: exit status 3: stand-in: no luck today"), HasSubstr("run.log")));
  behave("careless");
  EXPECT_THAT(error_of_run(), HasSubstr("run.json: particles.fluid: is missing"));
  behave("other");
  EXPECT_THAT(error_of_run(), HasSubstr("run.json: l0_m: is 0.5, not the 0.05 asked for"));
}

TEST_F(Peers, ResultsHaveGoogleBenchmarksForm) {
  const std::vector<PeerRuns> all{{stand_in, {run_peer(stand_in, task, folder / "run")}}};
  const nlohmann::json entry = to_benchmark_json(all, task)["benchmarks"].at(0);
  EXPECT_EQ(entry["name"], "peers/stand-in/kleefsman/l0:0.05/threads:1");
  EXPECT_EQ(entry["items_per_second"], 500000);
  EXPECT_EQ(entry["real_time"], 0.4);
  EXPECT_THAT(describe(all), HasSubstr("2000.0 (2000.0 to 2000.0)"));
}

TEST_F(Peers, ProgramRunsThemInRoundsAndComparesTheirSeries) {
  const char* program = std::getenv("COMPARE_PEERS_PROGRAM");
  const char* sluice = std::getenv("SLUICE_PROGRAM");
  ASSERT_TRUE(program != nullptr && sluice != nullptr) << "run by ctest, or set both";
  const fs::path results = folder / "results.json";
  const fs::path log = folder / "log";
  const int code =
      run_program({program, "stand-in", "--peers", "bench/peers", "--l0", "0.05", "--rounds", "2", "--sluice", sluice,
                   "--out", (folder / "out").string(), "--benchmark_out", results.string()},
                  log);
  ASSERT_EQ(code, 0) << last_line(log);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(results))["benchmarks"].size(), 2U);
  EXPECT_TRUE(fs::exists(folder / "out" / "report" / "index.html"));
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
}

}  // namespace
}  // namespace sluice::bench
