#include "solvers/snapshot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace sluice {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, removed when the test ends.
class SnapshotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::path(::testing::TempDir()) / (std::string("sluice_snapshot_") + info->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
};

ParticleSnapshot three_particles() {
  ParticleSnapshot s;
  s.time_s = 0.1;  // has no finite binary form, so that a lossy time would show
  s.fluid_count = 2;
  s.position_m = {{0.1F, 0.2F, 0.3F}, {1.1F, 1.2F, 1.3F}, {-2.0F, 1e-7F, 3e8F}};
  s.velocity_m_s = {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}};
  s.pressure_Pa = {100.5F, -3.25F, std::numeric_limits<float>::max()};
  s.density_kg_m3 = {1000, 1001.5F, 999};
  s.id = {17, 0, 2147483647};
  return s;
}

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void spill(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

std::string error_of(const fs::path& path) {
  try {
    read_vtp(path);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

void expect_error(const fs::path& path, const std::string& part) {
  const std::string error = error_of(path);
  EXPECT_NE(error.find(path.string()), std::string::npos) << error;
  EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST_F(SnapshotTest, ReadsBackWhatWasWritten) {
  const ParticleSnapshot s = three_particles();
  write_vtp(folder / "a.vtp", s);
  const ParticleSnapshot r = read_vtp(folder / "a.vtp");
  EXPECT_EQ(r.time_s, s.time_s);
  EXPECT_EQ(r.fluid_count, s.fluid_count);
  EXPECT_EQ(r.position_m, s.position_m);
  EXPECT_EQ(r.velocity_m_s, s.velocity_m_s);
  EXPECT_EQ(r.pressure_Pa, s.pressure_Pa);
  EXPECT_EQ(r.density_kg_m3, s.density_kg_m3);
  EXPECT_EQ(r.id, s.id);
  EXPECT_FALSE(fs::exists(folder / "a.vtp.part"));
}

TEST_F(SnapshotTest, AnEmptySnapshotIsAFileToo) {
  write_vtp(folder / "a.vtp", {});
  EXPECT_TRUE(read_vtp(folder / "a.vtp").position_m.empty());
}

// The offsets are counted by hand, from the format's description: each block is eight bytes of length, then its data.
TEST_F(SnapshotTest, TheHeaderPointsAtTheBlocks) {
  write_vtp(folder / "a.vtp", three_particles());
  const std::string text = slurp(folder / "a.vtp");
  for (const char* array : {"Name=\"velocity\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"",
                            "Name=\"pressure\" NumberOfComponents=\"1\" format=\"appended\" offset=\"44\"",
                            "Name=\"density\" NumberOfComponents=\"1\" format=\"appended\" offset=\"64\"",
                            "Name=\"id\" NumberOfComponents=\"1\" format=\"appended\" offset=\"84\"",
                            "Name=\"kind\" NumberOfComponents=\"1\" format=\"appended\" offset=\"104\"",
                            "Name=\"position\" NumberOfComponents=\"3\" format=\"appended\" offset=\"115\""})
    EXPECT_NE(text.find(array), std::string::npos) << array;
  const std::size_t data = text.find("\n_") + 2;
  float x = 0;
  text.copy(reinterpret_cast<char*>(&x), 4, data + 115 + 8);
  EXPECT_EQ(x, 0.1F);
  const std::string kinds = text.substr(data + 104 + 8, 3);
  EXPECT_EQ(kinds, std::string("\0\0\1", 3));
}

TEST_F(SnapshotTest, RefusesWhatIsNotOurs) {
  spill(folder / "foreign.vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\"></VTKFile>\n");
  expect_error(folder / "foreign.vtp", "is not a snapshot written by sluice");
  spill(folder / "empty.vtp", "");
  expect_error(folder / "empty.vtp", "is not a snapshot written by sluice");
  expect_error(folder / "none.vtp", "cannot be opened");
}

TEST_F(SnapshotTest, SaysWhereAFileIsCutShort) {
  write_vtp(folder / "a.vtp", three_particles());
  const std::string text = slurp(folder / "a.vtp");
  spill(folder / "header.vtp", text.substr(0, 200));
  expect_error(folder / "header.vtp", "ends within its header");
  spill(folder / "data.vtp", text.substr(0, text.size() - 60));
  expect_error(folder / "data.vtp", "cut short");
}

TEST_F(SnapshotTest, NoticesDamage) {
  write_vtp(folder / "a.vtp", three_particles());
  const std::string text = slurp(folder / "a.vtp");
  const std::size_t data = text.find("\n_") + 2;

  std::string more = text;
  more.replace(more.find("NumberOfPoints=\"3\""), 18, "NumberOfPoints=\"9\"");
  spill(folder / "count.vtp", more);
  expect_error(folder / "count.vtp", "header is not as sluice writes it");

  std::string block = text;
  block[data + 44] = 11;  // the pressure block's own length
  spill(folder / "block.vtp", block);
  expect_error(folder / "block.vtp", "array 'pressure' holds 11 bytes where 12 belong");

  std::string kind = text;
  kind[data + 104 + 8] = 1;  // a wall particle before fluid
  spill(folder / "kind.vtp", kind);
  expect_error(folder / "kind.vtp", "'kind'");
}

TEST_F(SnapshotTest, RefusesArraysOfDifferentLength) {
  ParticleSnapshot s = three_particles();
  s.id.pop_back();
  EXPECT_THROW(write_vtp(folder / "a.vtp", s), std::invalid_argument);
  s = three_particles();
  s.fluid_count = 4;
  EXPECT_THROW(write_vtp(folder / "a.vtp", s), std::invalid_argument);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(SnapshotTest, NamesAFileThatCannotBeWritten) {
  EXPECT_THROW(write_vtp(folder / "nowhere" / "a.vtp", three_particles()), std::runtime_error);
}

TEST_F(SnapshotTest, AFullDiskIsAnErrorAndLeavesNothingBehind) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  fs::create_symlink("/dev/full", folder / "a.vtp.part");
  EXPECT_THROW(write_vtp(folder / "a.vtp", three_particles()), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(SnapshotTest, TheCollectionFollowsEachSnapshot) {
  SnapshotWriter writer(folder);
  ParticleSnapshot s = three_particles();
  for (const double time : {0.0, 0.1, 0.2}) {
    s.time_s = time;
    const fs::path file = writer.write(s);
    const std::vector<SnapshotEntry> entries = read_pvd(folder / "snapshots.pvd");
    ASSERT_EQ(entries.size(), writer.count());
    EXPECT_EQ(entries.back().time_s, time);
    EXPECT_EQ(entries.back().file, file);
    EXPECT_EQ(read_vtp(entries.back().file).time_s, time);
  }
  EXPECT_EQ(writer.count(), 3U);
}

TEST_F(SnapshotTest, ACollectionCutShortIsAnError) {
  SnapshotWriter(folder).write(three_particles());
  const std::string text = slurp(folder / "snapshots.pvd");
  spill(folder / "snapshots.pvd", text.substr(0, text.size() - 12));
  EXPECT_THROW(read_pvd(folder / "snapshots.pvd"), std::runtime_error);
  EXPECT_THROW(read_pvd(folder / "none.pvd"), std::runtime_error);
}

}  // namespace
}  // namespace sluice
