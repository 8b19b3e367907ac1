// Runs that are interrupted and gone on with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <memory>

#include "validation/checkpoint.h"
#include "validation/cli/program_test.h"
#include "validation/fake_solver.h"
#include "validation/legs.h"
#include "validation/run.h"
#include "validation/run_cost.h"
#include "validation/run_directory.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

using program_test::contents;

// A run that is interrupted and resumed, with the fake solver.
class ResumeTest : public program_test::InDirectory {
 protected:
  ResumeTest() : InDirectory("sluice-resume"), c(load_case("kleefsman")) {
    request.l0_m = 0.05;
    request.threads = 1;
    request.snapshot_every_s = 0.01;
    request.overrides = {{"t_end_s", 0.05}};
    factory = [this](const Case&, const Scene& scene, const RunSettings&) {
      auto solver = std::make_unique<FakeSolver>(scene, 4e-4);
      solver->before_step = trouble;
      return solver;
    };
  }

  RunOutcome run(const fs::path& out) {
    RunOptions options;
    options.out = out;
    options.factory = factory;
    return run_case(c, resolve_settings(c, request), options);
  }
  RunOutcome resume(const fs::path& out, int threads = 0) {
    ResumeOptions options;
    options.threads = threads;
    options.factory = factory;
    return resume_run(out, options);
  }

  Case c;
  RunRequest request;
  SolverFactory factory;
  std::function<void(FakeSolver&)> trouble;
};

// A second program, as another lock in this process: it is refused whatever it wants, and disturbs nothing.
TEST_F(ResumeTest, NobodyElseComesIntoARunThatGoesOn) {
  EXPECT_EQ(run(directory / "whole").status, "finished");
  const fs::path out = directory / "shared";
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() == 30) std::raise(SIGTERM);
  };
  EXPECT_EQ(run(out).status, "interrupted");
  int refused = 0;
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() != 60) return;
    RunOptions anew;
    anew.out = out;
    anew.force = true;
    for (const std::function<void()>& second : {std::function<void()>([&] { resume(out); }), std::function<void()>([&] {
                                                  run_case(c, resolve_settings(c, request), anew);
                                                })}) {
      try {
        second();
      } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(out.string()), HasSubstr("computes here at this moment")));
        ++refused;
      }
    }
  };
  EXPECT_EQ(resume(out).status, "finished");
  EXPECT_EQ(refused, 2);
  EXPECT_EQ(contents(out / "probes.csv"), contents(directory / "whole" / "probes.csv"));
}

TEST_F(ResumeTest, ComesOutAsInOneGo) {
  EXPECT_EQ(run(directory / "whole").status, "finished");
  EXPECT_FALSE(fs::exists(directory / "whole" / checkpoint_file)) << "a finished run needs none";
  const fs::path parts = directory / "parts";
  std::int64_t stop_at = 30;
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() == stop_at) std::raise(SIGTERM);
  };
  EXPECT_EQ(run(parts).status, "interrupted");
  EXPECT_TRUE(fs::exists(parts / checkpoint_file));
  stop_at = 77;
  EXPECT_EQ(resume(parts).exit_code, 128 + SIGTERM);
  stop_at = -1;
  EXPECT_EQ(resume(parts).status, "finished");
  EXPECT_EQ(contents(parts / "probes.csv"), contents(directory / "whole" / "probes.csv"));
  EXPECT_EQ(contents(parts / "snapshots.pvd"), contents(directory / "whole" / "snapshots.pvd"));
  const RunRecord record = read_run(parts);
  EXPECT_EQ(record.number("resumed"), 2);
  EXPECT_EQ(record.number("steps"), read_run(directory / "whole").number("steps"));
  EXPECT_EQ(record.number("particle_steps_per_s").has_value(), true);
  EXPECT_NEAR(*record.number("phases.sums"), 1.5, 1e-9) << "half a second in each of three parts";
  EXPECT_EQ(record.snapshots().size(), 6U);
  EXPECT_EQ(record.manifest.at("legs").size(), 3U);
  EXPECT_EQ(difference_of_legs(record.manifest), "");
}

// Its time is that of neither number of threads, and who reads the results must know.
TEST_F(ResumeTest, TellsWhatComputedItsParts) {
  EXPECT_EQ(run(directory / "whole").status, "finished");
  const fs::path parts = directory / "parts";
  std::int64_t stop_at = 30;
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() == stop_at) std::raise(SIGTERM);
  };
  run(parts);
  stop_at = 60;
  resume(parts, 2);
  stop_at = -1;
  EXPECT_EQ(resume(parts).status, "finished");
  const auto manifest = read_run(parts).manifest;
  const std::string difference = "its parts were computed with different threads (1, then 2)";
  EXPECT_EQ(difference_of_legs(manifest), difference);
  EXPECT_EQ(std::count(manifest.at("warnings").begin(), manifest.at("warnings").end(), difference), 1) << manifest;
  EXPECT_EQ(manifest.at("legs").at(1).at("threads"), 2);
  EXPECT_NEAR(manifest.at("legs").at(1).at("from_s").get<double>(), 31 * 4e-4, 1e-9);
  EXPECT_EQ(run_costs({directory / "whole", parts}).size(), 1U);
}

TEST_F(ResumeTest, RowsBehindTheCheckpointAreCutOff) {
  EXPECT_EQ(run(directory / "whole").status, "finished");
  const fs::path parts = directory / "parts";
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  run(parts);
  trouble = nullptr;
  std::ofstream(parts / "probes.csv", std::ios::app) << "0.03,1,2,3\n0.0";  // as a killed run leaves it
  EXPECT_EQ(resume(parts).status, "finished");
  EXPECT_EQ(contents(parts / "probes.csv"), contents(directory / "whole" / "probes.csv"));
}

/// Makes that the next checkpoint finds no room.
void fill_disk(const fs::path& run) {
  fs::create_symlink("/dev/full", (run / checkpoint_file).string() + ".part");
}

TEST_F(ResumeTest, AnInterruptionWithoutACheckpointIsAnError) {
  const fs::path out = directory / "full";
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() == 30) fill_disk(out);
    if (solver.steps() == 30) std::raise(SIGTERM);
  };
  const RunOutcome outcome = run(out);
  EXPECT_EQ(outcome.status, "interrupted") << "a campaign ends with it";
  EXPECT_EQ(outcome.exit_code, 1) << "nobody puts it back into a queue";
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("without a checkpoint"), HasSubstr("No space left")));
  EXPECT_EQ(read_run(out).text("error"), outcome.error);
}

TEST_F(ResumeTest, SnapshotsThatFindNoRoomAreToldAndTheRunGoesOn) {
  const fs::path out = directory / "full";
  trouble = [&](FakeSolver& solver) {
    if (solver.steps() == 30) {
      fs::remove_all(out / "snapshots");
      std::ofstream(out / "snapshots") << "in the way";
    }
  };
  EXPECT_EQ(run(out).status, "finished");
  const auto warnings = read_run(out).warnings();
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("snapshots")));
}

TEST_F(ResumeTest, ACheckpointWithoutItsManifestIsNobodyElses) {
  const fs::path out = directory / "left";
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 30) std::raise(SIGTERM);
  };
  run(out);
  fs::remove(out / "run.json");
  EXPECT_THROW(run(out), std::runtime_error) << "a new run could be gone on with from it";
  trouble = nullptr;
  RunOptions anew;
  anew.out = out;
  anew.force = true;
  anew.factory = factory;
  EXPECT_EQ(run_case(c, resolve_settings(c, request), anew).status, "finished");
}

TEST_F(ResumeTest, WhatAnOlderProgramLacksIsNamed) {
  const fs::path out = directory / "older";
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 30) std::raise(SIGTERM);
  };
  run(out);
  nlohmann::json header = read_checkpoint_header(out / checkpoint_file);
  header.at("settings").at("parameters").erase("courant");
  FakeSolver state(Scene{}, 1e-3);
  write_checkpoint(out / checkpoint_file, header, state);
  try {
    resume(out);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("checkpoint.h5"), HasSubstr("no parameter courant")));
  }
}

TEST_F(ResumeTest, GoesOnWithACaseThatHasMoved) {
  const fs::path moved = directory / "moved.toml";
  fs::copy_file(c.file, moved);
  c = load_case(moved.string());
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  const fs::path parts = directory / "parts";
  run(parts);
  fs::remove(moved);
  try {
    resume(parts);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(moved.string()), HasSubstr("--case FILE")));
  }
  trouble = {};
  ResumeOptions options;
  options.factory = factory;
  options.the_case = load_case("kleefsman");
  EXPECT_EQ(resume_run(parts, options).status, "finished");
}

TEST_F(ResumeTest, GoesOnWhereOnlyWordsAndBandsOfTheCaseHaveChanged) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  const fs::path parts = directory / "parts";
  run(parts);
  trouble = {};
  std::string text = "# A remark.\n" + contents(c.file);
  const auto band = text.rfind("within = ");
  ASSERT_NE(band, std::string::npos);
  ResumeOptions options;
  options.factory = factory;
  options.the_case = parse_case(text.insert(band + 9, "1"), c.file.string());
  nlohmann::json header = read_checkpoint_header(parts / checkpoint_file);
  const fs::path older = directory / "older";
  fs::copy(parts, older, fs::copy_options::recursive);
  FakeSolver state(Scene{}, 1e-3);
  header.erase("computed_hash");
  write_checkpoint(older / checkpoint_file, header, state);
  EXPECT_THROW(resume_run(older, options), std::runtime_error) << "it does not tell what it was computed from";
  EXPECT_EQ(resume_run(parts, options).status, "finished");
  EXPECT_EQ(read_run(parts).text("case_hash"), options.the_case->hash);
}

TEST_F(ResumeTest, RefusesACaseOfOtherInputs) {
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  const fs::path parts = directory / "parts";
  run(parts);
  std::string text = contents(c.file);
  const std::string rate = "output_rate_Hz = 1000.0";
  ASSERT_NE(text.find(rate), std::string::npos);
  ResumeOptions options;
  options.factory = factory;
  options.the_case = parse_case(text.replace(text.find(rate), rate.size(), "output_rate_Hz = 500.0"), c.file.string());
  try {
    resume_run(parts, options);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(c.file.string()), HasSubstr("has changed in what is computed")));
  }
}

TEST_F(ResumeTest, RefusesWhatItCannotGoOnWith) {
  const auto refusal = [&](const fs::path& out) -> std::string {
    try {
      resume(out);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal(directory / "nowhere"), HasSubstr("no such file"));
  run(directory / "whole");
  EXPECT_THAT(refusal(directory / "whole"), HasSubstr("has finished"));
  const fs::path parts = directory / "parts";
  trouble = [](FakeSolver& solver) {
    if (solver.steps() == 60) std::raise(SIGINT);
  };
  run(parts);
  EXPECT_THROW(run(parts), std::runtime_error) << "replacing it would lose what was computed";
  fs::resize_file(parts / "probes.csv", 100);
  EXPECT_THAT(refusal(parts), AllOf(HasSubstr("probes.csv"), HasSubstr("cannot be continued")));
}

}  // namespace
}  // namespace sluice
