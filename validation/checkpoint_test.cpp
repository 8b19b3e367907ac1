#include "validation/checkpoint.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "solvers/state_archive.h"
#include "validation/cli/program_test.h"
#include "validation/fake_solver.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

using program_test::contents;

// A solver with something of every kind to remember.
class Rememberer : public FakeSolver {
 public:
  explicit Rememberer(std::size_t n = 1000) : FakeSolver(Scene{}, 1e-3), doubles(n), floats(n), integers(n) {}
  void visit_state(StateArchive& archive) override {
    FakeSolver::visit_state(archive);
    archive.values("doubles", std::span(doubles));
    archive.values("floats", std::span(floats));
    archive.values("integers", std::span(integers));
  }
  std::vector<double> doubles;
  std::vector<float> floats;
  std::vector<std::int32_t> integers;
};

class CheckpointTest : public testing::Test {
 protected:
  CheckpointTest() {
    directory = fs::temp_directory_path() /
                (std::string("sluice-checkpoint-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory);
    fs::create_directories(directory);
    file = directory / checkpoint_file;
  }
  ~CheckpointTest() override { fs::remove_all(directory); }

  std::string refusal() const {
    try {
      Rememberer solver;
      read_checkpoint_header(file);
      restore_checkpoint(file, solver);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path directory;
  fs::path file;
};

TEST_F(CheckpointTest, GivesBackWhatItWasGiven) {
  Rememberer saved;
  for (std::size_t i = 0; i < 1000; ++i) {
    saved.doubles[i] = 1.0 / static_cast<double>(i + 3);
    saved.floats[i] = 1.0F / static_cast<float>(i + 3);
    saved.integers[i] = -static_cast<std::int32_t>(i);
  }
  for (int k = 0; k < 7; ++k) saved.step();
  write_checkpoint(file, {{"words", "über"}}, saved);
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
  Rememberer restored;
  EXPECT_EQ(read_checkpoint_header(file).at("words"), "über");
  restore_checkpoint(file, restored);
  EXPECT_EQ(restored.time_s(), saved.time_s());
  EXPECT_EQ(restored.steps(), 7);
  EXPECT_EQ(restored.doubles, saved.doubles);
  EXPECT_EQ(restored.floats, saved.floats);
  EXPECT_EQ(restored.integers, saved.integers);
}

/// HDF5 would lock the file, which fails where others hold it or the file system knows no locks, and would then pass
/// for damage.
TEST_F(CheckpointTest, IsReadWhereItCannotBeLocked) {
  Rememberer solver;
  write_checkpoint(file, {{"a", 1}}, solver);
  const int held = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(refusal(), "accepted");
  ::close(held);
}

TEST_F(CheckpointTest, OfNoParticlesToo) {
  Rememberer none(0);
  write_checkpoint(file, {}, none);
  restore_checkpoint(file, none);
  EXPECT_THAT(refusal(), HasSubstr("doubles has 0 values where 1000 belong"));
}

TEST_F(CheckpointTest, RefusesWhatIsNone) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr(file.string()), HasSubstr("no such file")));
  std::ofstream(file) << "t_s,P1_Pa\n0,1\n";
  EXPECT_THAT(refusal(), AllOf(HasSubstr("no HDF5 file"), HasSubstr("--force")));
  H5Fclose(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_THAT(refusal(), HasSubstr("no checkpoint"));
}

TEST_F(CheckpointTest, RefusesAFileCutShortAnywhere) {
  Rememberer solver;
  write_checkpoint(file, {{"a", 1}}, solver);
  const std::string whole = contents(file);
  for (std::size_t part = 0; part < 20; ++part) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() * part / 20);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(file.string()), HasSubstr("--force"))) << part;
  }
}

TEST_F(CheckpointTest, RefusesADamagedFile) {
  Rememberer solver;
  solver.doubles.assign(1000, 1.25);
  write_checkpoint(file, {{"a", 1}}, solver);
  std::string bytes = contents(file);
  const double value = 1.25;
  const std::string pattern(reinterpret_cast<const char*>(&value), sizeof value);
  const auto at = bytes.find(pattern + pattern);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_THAT(refusal(), HasSubstr("damaged"));
}

TEST_F(CheckpointTest, AFailedWriteLeavesTheOlderOne) {
  Rememberer solver;
  write_checkpoint(file, {{"a", 1}}, solver);
  const std::string older = contents(file);
  fs::create_symlink("/dev/full", file.string() + ".part");
  try {
    write_checkpoint(file, {{"a", 2}}, solver);
    FAIL() << "written to a full disk";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("No space left"));
  }
  EXPECT_EQ(contents(file), older);
  write_checkpoint(file, {{"a", 3}}, solver);  // there is room again
  EXPECT_EQ(read_checkpoint_header(file).at("a"), 3);
}

}  // namespace
}  // namespace sluice
