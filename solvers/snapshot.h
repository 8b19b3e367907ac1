// Particle snapshots on disk: VTK XML PolyData (.vtp) for ParaView, a .pvd collection that gives them their times, and
// a reader of our own files for the reports. Format: VTK File Formats, "XML File Formats" (docs.vtk.org); data appended
// raw, little-endian, 64-bit block headers.
#pragma once

#include <filesystem>
#include <vector>

#include "solvers/solver.h"

namespace sluice {

/// Writes one snapshot: points, velocity [m/s], pressure [Pa], density [kg/m3], id, and kind (0 fluid, 1 wall), with
/// one vertex cell a particle so that ParaView shows points at once. The file appears whole or not at all. Throws
/// std::invalid_argument when the arrays differ in length, std::runtime_error when the file cannot be written.
void write_vtp(const std::filesystem::path& path, const ParticleSnapshot& snapshot);

/// Reads a file that write_vtp() wrote, bit for bit. Other programs' .vtp files are refused, as are damaged ones.
/// Throws std::runtime_error naming the file and what is wrong with it.
ParticleSnapshot read_vtp(const std::filesystem::path& path);

/// One line of a .pvd collection; the file is resolved against the collection's own folder.
struct SnapshotEntry {
  double time_s = 0;
  std::filesystem::path file;
};

/// Reads a collection that SnapshotWriter wrote, in order of time. Throws std::runtime_error as read_vtp().
std::vector<SnapshotEntry> read_pvd(const std::filesystem::path& path);

/// Numbers the snapshots of one run: <run>/snapshots/particles_0000.vtp and on, with <run>/snapshots.pvd brought up to
/// date after each one, so that an interrupted run leaves a collection that ParaView opens. Starts a new collection.
class SnapshotWriter {
 public:
  explicit SnapshotWriter(std::filesystem::path run_directory);
  /// Goes on behind the first `kept` snapshots of the collection that is there. Throws as read_pvd(), or when it holds
  /// fewer.
  SnapshotWriter(std::filesystem::path run_directory, std::size_t kept);

  /// Writes one snapshot and the collection. Returns the snapshot's path. Throws as write_vtp().
  std::filesystem::path write(const ParticleSnapshot& snapshot);

  std::size_t count() const { return entries_.size(); }

 private:
  std::filesystem::path run_directory_;
  std::vector<SnapshotEntry> entries_;  // files relative to the run directory
};

}  // namespace sluice
