#include "validation/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <limits>

#include "validation/fake_solver.h"
#include "validation/manifest.h"
#include "validation/run_directory.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t plenty = std::int64_t{1} << 40;

// Runs the shipped case, coarse and short, with the fake solver.
class RunTest : public testing::Test {
 protected:
  RunTest() : c(load_case("kleefsman")) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory = fs::temp_directory_path() / (std::string("sluice-run-test-") + test->name());
    fs::remove_all(directory);
    request.l0_m = 0.05;
    request.threads = 1;
    request.overrides = {{"t_end_s", 0.0499}};
    options.out = directory;
    options.available_memory_bytes = plenty;
    options.factory = [this](const Case&, const Scene& scene, const RunSettings&) {
      auto solver = std::make_unique<FakeSolver>(scene, 4e-4);
      solver->before_step = trouble;
      return solver;
    };
  }
  ~RunTest() override { fs::remove_all(directory); }

  RunOutcome run() { return run_case(c, resolve_settings(c, request), options); }

  std::string log_text() const {
    std::ifstream in(directory / "log.txt");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Case c;
  RunRequest request;
  RunOptions options;
  fs::path directory;
  std::function<void(FakeSolver&)> trouble;
};

TEST_F(RunTest, SamplesAtTheFirstStepAtOrAfterEachMillisecond) {
  EXPECT_EQ(run().status, "finished");
  const RunRecord record = read_run(directory);
  // t = 0, then 0.0012 (first of 0.4 ms steps at or after 1 ms), 0.0020, 0.0032, ...: one a millisecond.
  const auto& t = record.probes.times_s();
  ASSERT_EQ(t.size(), 51u);
  EXPECT_NEAR(t[1], 0.0012, 1e-12);
  EXPECT_NEAR(t[2], 0.0020, 1e-12);
  EXPECT_NEAR(t[3], 0.0032, 1e-12);
  for (std::size_t k = 0; k < t.size(); ++k) {
    EXPECT_GE(t[k], 1e-3 * static_cast<double>(k) - 1e-9);
    EXPECT_LT(t[k], 1e-3 * static_cast<double>(k) + 4e-4);
  }
}

TEST_F(RunTest, ColumnsHoldEveryModelAndThePrimaryReading) {
  run();
  const ProbeTable probes = read_run(directory).probes;
  const double t = probes.times_s().back();
  EXPECT_NEAR(probes.values("P1_wall_Pa").back(), 2000 * t, 1e-6 * 2000 * t);
  EXPECT_NEAR(probes.values("P1_kernel_Pa").back(), 1000 * t, 1e-6 * 1000 * t);
  EXPECT_EQ(probes.values("P1_Pa"), probes.values("P1_wall_Pa"));  // primary with extrapolated walls
  EXPECT_EQ(probes.values("H1_m"), probes.values("H1_column_m"));
  for (const CaseSensor& sensor : c.sensors) EXPECT_TRUE(probes.has(probe_column(sensor))) << sensor.name;
}

TEST_F(RunTest, DynamicWallsMakeTheKernelModelPrimary) {
  request.walls = "dynamic";
  run();
  const RunRecord record = read_run(directory);
  EXPECT_EQ(record.probes.values("P1_Pa"), record.probes.values("P1_kernel_Pa"));
  EXPECT_EQ(record.text("sensors.P1.primary"), "kernel");
}

TEST_F(RunTest, ManifestTellsTheRun) {
  run();
  const RunRecord r = read_run(directory);
  EXPECT_EQ(r.number("schema"), 1);
  EXPECT_EQ(r.case_name, "kleefsman");
  EXPECT_EQ(r.solver, "wcsph");
  EXPECT_EQ(r.walls, "extrapolated");
  EXPECT_EQ(r.l0_m, 0.05);
  EXPECT_EQ(r.alpha(), 0.01);
  EXPECT_EQ(r.status(), "finished");
  EXPECT_EQ(r.number("t_end_s"), 0.0499);
  EXPECT_EQ(r.number("steps"), 125);
  EXPECT_NEAR(r.number("time_s").value(), 0.05, 1e-9);
  EXPECT_NEAR(r.number("dt_mean_s").value(), 4e-4, 1e-12);
  EXPECT_EQ(r.number("dt_min_s"), 4e-4);
  EXPECT_EQ(r.number("lost.over_top"), 3);
  EXPECT_EQ(r.number("lost.through_walls"), 0);
  EXPECT_EQ(r.number("facts.c0_m_s"), 46.5);
  EXPECT_EQ(r.number("phases.sums"), 0.5);
  EXPECT_EQ(r.number("bytes_per_particle"), 100);
  EXPECT_EQ(r.number("parameters.courant"), 0.2);
  EXPECT_GT(r.number("particle_steps_per_s").value(), 0);
  EXPECT_GT(r.number("peak_memory_bytes").value(), 1e6);
  EXPECT_EQ(r.text("commit"), build_info().commit);
  EXPECT_EQ(r.text("case_hash"), c.hash);
  EXPECT_EQ(r.text("computed_hash"), c.computed_hash);
  // nu0 = alpha h c0 / 10 with h = 1.5 l0 and c0 = 20 sqrt(g H_W).
  EXPECT_NEAR(r.number("equivalent_viscosity_m2_s").value(), 0.01 * 0.075 * 20 * std::sqrt(9.81 * 0.55) / 10, 1e-9);
  const Scene scene = build_scene(scene_description(c, 0.05, 3));
  EXPECT_EQ(r.number("particles.fluid"), static_cast<double>(scene.fluid.size()));
  EXPECT_EQ(r.number("particles.solid"), static_cast<double>(scene.walls.size()));
  EXPECT_EQ(r.number("fluid_volume.nominal_m3"), scene.nominal_fluid_volume_m3);
}

TEST_F(RunTest, AFailureKeepsWhatWasComputed) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 50) throw std::runtime_error("the moon fell into the tank");
  };
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, "failed");
  EXPECT_EQ(outcome.exit_code, 1);
  const RunRecord record = read_run(directory);
  EXPECT_EQ(record.status(), "failed");
  EXPECT_EQ(record.text("error"), "the moon fell into the tank");
  EXPECT_EQ(record.number("steps"), 50);
  EXPECT_NEAR(record.probes.times_s().back(), 0.02, 1e-9);
}

TEST_F(RunTest, AFailureSavesTheStateItFailedAt) {
  options.log_steps = false;
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 50) throw std::runtime_error("no convergence");
  };
  run();
  ASSERT_EQ(read_run(directory).snapshots().size(), 1u);
  EXPECT_THAT(log_text(), AllOf(HasSubstr("snapshot at t = 0.0200 s"), HasSubstr("note of step 50")));
}

TEST_F(RunTest, StepsAreLoggedOnRequestOnly) {
  run();
  EXPECT_THAT(log_text(), Not(HasSubstr("note of step")));
  options.force = true;
  options.log_steps = true;
  run();
  EXPECT_THAT(log_text(), AllOf(HasSubstr("step 1, t = 0.000400 s, dt = 4.000e-04 s, note of step 1\n"),
                                HasSubstr("note of step 125\n")));
}

TEST_F(RunTest, ValuesThatAreNoNumbersEndTheRun) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 20) solver.set_pressure_scale(std::numeric_limits<double>::quiet_NaN());
  };
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, "failed");
  EXPECT_THAT(outcome.error, HasSubstr("P1"));
  EXPECT_GT(read_run(directory).probes.rows(), 5u);
}

TEST_F(RunTest, ATimeStepThatIsNoNumberEndsTheRun) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 20) solver.set_dt_s(std::numeric_limits<double>::quiet_NaN());
  };
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, "failed");
  EXPECT_THAT(outcome.error, HasSubstr("time step"));
}

TEST_F(RunTest, InterruptionEndsCleanlyWithTheShellsCode) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, "interrupted");
  EXPECT_EQ(outcome.exit_code, 130);
  const RunRecord record = read_run(directory);
  EXPECT_EQ(record.status(), "interrupted");
  EXPECT_EQ(record.number("steps"), 61);
  EXPECT_NEAR(record.probes.times_s().back(), 0.024, 1e-9);
}

TEST_F(RunTest, TerminationEndsCleanlyToo) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 10) std::raise(SIGTERM);
  };
  EXPECT_EQ(run().exit_code, 143);
}

/// Who computes one run after another must stop, whatever became of this one.
TEST_F(RunTest, ASignalIsNotLostInARunThatEndsByItself) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 124) std::raise(SIGINT);  // in the last step
  };
  const RunOutcome last = run();
  EXPECT_EQ(last.status, "finished");
  EXPECT_EQ(last.exit_code, 0);
  EXPECT_EQ(last.stop_code(), 130);
  trouble = [](FakeSolver&) {
    std::raise(SIGTERM);
    throw std::runtime_error("out of luck");
  };
  options.force = true;
  const RunOutcome failed = run();
  EXPECT_EQ(failed.status, "failed");
  EXPECT_EQ(failed.stop_code(), 1);
  trouble = {};
  EXPECT_EQ(run().stop_code(), 0);
}

TEST_F(RunTest, TheSameRequestByTwoWaysEndsCleanly) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 10) {
      std::raise(SIGTERM);
      std::raise(SIGTERM);
    }
  };
  EXPECT_EQ(run().exit_code, 143);
}

TEST_F(RunTest, AFinishedRunIsNotReplacedUnlessForced) {
  EXPECT_EQ(run().status, "finished");
  try {
    run();
    FAIL() << "replaced";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(directory.string()), HasSubstr("--force")));
  }
  options.force = true;
  EXPECT_EQ(run().status, "finished");
}

TEST_F(RunTest, AnInterruptedRunIsNotReplacedUnlessForced) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 5) std::raise(SIGINT);
  };
  EXPECT_EQ(run().status, "interrupted");
  trouble = nullptr;
  EXPECT_THROW(run(), std::runtime_error) << "it can go on";
  options.force = true;
  EXPECT_EQ(run().status, "finished");
}

TEST_F(RunTest, ARunThatFailedBeforeItsFirstRowIsReplaced) {
  const SolverFactory good = options.factory;
  options.factory = [](const Case&, const Scene&, const RunSettings&) -> std::unique_ptr<Solver> {
    throw std::invalid_argument("out of its range");
  };
  EXPECT_EQ(run().status, "failed");
  options.factory = good;
  EXPECT_EQ(run().status, "finished");
}

TEST_F(RunTest, AFailedRunWithRowsIsNotReplacedUnlessForced) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 5) throw std::runtime_error("out of luck");
  };
  EXPECT_EQ(run().status, "failed");
  trouble = nullptr;
  EXPECT_THROW(run(), std::runtime_error) << "its series and its last state tell why it failed";
  EXPECT_EQ(read_run(directory).snapshots().size(), 1u);
  options.force = true;
  EXPECT_EQ(run().status, "finished");
}

TEST_F(RunTest, AnotherCodesResultsAreNotReplaced) {
  fs::create_directories(directory);
  std::ofstream(directory / "run.json") << R"({"case": "kleefsman", "solver": "other", "l0_m": 0.02})";
  EXPECT_THROW(run(), std::runtime_error);
}

TEST_F(RunTest, SnapshotsComeAtTheFirstStepAtOrAfterTheirTimes) {
  request.snapshot_every_s = 0.01;
  run();
  EXPECT_EQ(read_run(directory).snapshots().size(), 5u);  // 0, 0.01, ..., 0.04
  EXPECT_TRUE(fs::exists(directory / "snapshots.pvd"));
}

TEST_F(RunTest, WithoutARequestThereAreNoSnapshots) {
  run();
  EXPECT_TRUE(read_run(directory).snapshots().empty());
}

TEST_F(RunTest, RefusesWhatDoesNotFitInMemoryAndNamesWhatWould) {
  request.l0_m = 0.0075;
  options.available_memory_bytes = 200 << 20;
  try {
    run();
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("l0 = 0.0075 m needs"), HasSubstr("use --l0 0.0")));
  }
  EXPECT_FALSE(fs::exists(directory));
}

TEST_F(RunTest, AFullDiskIsToldAndTheRunFails) {
  fs::create_directories(directory);
  fs::create_symlink("/dev/full", directory / "probes.csv");
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, "failed");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("probes.csv"), HasSubstr("No space left")));
}

TEST_F(RunTest, ASolverThatCannotBeMadeLeavesItsReason) {
  options.factory = [](const Case&, const Scene&, const RunSettings&) -> std::unique_ptr<Solver> {
    throw std::invalid_argument("gamma = 5 is out of its range");
  };
  EXPECT_EQ(run().status, "failed");
  const RunRecord record = read_run(directory);
  EXPECT_EQ(record.text("error"), "gamma = 5 is out of its range");
  EXPECT_TRUE(record.text("machine")) << "whose failure it was";
  EXPECT_TRUE(record.number("t_end_s"));
  EXPECT_EQ(record.probes.rows(), 0u);
}

}  // namespace
}  // namespace sluice
