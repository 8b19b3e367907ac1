#include "solvers/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string_view>

#include "solvers/bring_to_disk.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "snapshots are written as the machine holds them");
static_assert(sizeof(Vec3<float>) == 3 * sizeof(float));

constexpr std::string_view signature = "<!-- Sluice particle snapshot, version 1 -->";
constexpr std::string_view appended_open = "<AppendedData encoding=\"raw\">\n_";
constexpr std::string_view appended_close = "\n</AppendedData>\n</VTKFile>\n";
// Far beyond our header's length; bounds how much of a foreign file is looked at.
constexpr std::size_t longest_header = 8192;

enum Section { point_data, points, verts };

// The layout of our files: one array after the other in this order.
struct ArrayLayout {
  std::string_view name;
  std::string_view type;
  int components;
  int value_bytes;
  Section section;
};
constexpr std::array<ArrayLayout, 8> layout = {{{"velocity", "Float32", 3, 4, point_data},
                                                {"pressure", "Float32", 1, 4, point_data},
                                                {"density", "Float32", 1, 4, point_data},
                                                {"id", "Int32", 1, 4, point_data},
                                                {"kind", "UInt8", 1, 1, point_data},
                                                {"position", "Float32", 3, 4, points},
                                                {"connectivity", "Int32", 1, 4, verts},
                                                {"offsets", "Int32", 1, 4, verts}}};

using BlockHeader = std::uint64_t;

std::uint64_t payload_bytes(const ArrayLayout& array, std::size_t count) {
  return static_cast<std::uint64_t>(array.components) * static_cast<std::uint64_t>(array.value_bytes) * count;
}

std::uint64_t block_offset(std::size_t index, std::size_t count) {
  std::uint64_t offset = 0;
  for (std::size_t i = 0; i < index; ++i) offset += sizeof(BlockHeader) + payload_bytes(layout[i], count);
  return offset;
}

std::string section_xml(Section section, std::size_t count) {
  std::string xml;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (layout[i].section != section) continue;
    xml += fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        layout[i].type, layout[i].name, layout[i].components, block_offset(i, count));
  }
  return xml;
}

// Everything before the appended data. It follows from the count and the time alone, which the reader makes use of: a
// file is ours exactly if its header is the one that its own count and time give.
std::string header_xml(std::size_t count, double time_s) {
  std::string xml = "<?xml version=\"1.0\"?>\n";
  xml += signature;
  xml += fmt::format(
      "\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <PolyData>\n"
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
      "    </FieldData>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      time_s, count, count);
  xml += "      <PointData Scalars=\"pressure\" Vectors=\"velocity\">\n" + section_xml(point_data, count);
  xml += "      </PointData>\n      <Points>\n" + section_xml(points, count);
  xml += "      </Points>\n      <Verts>\n" + section_xml(verts, count);
  xml += "      </Verts>\n    </Piece>\n  </PolyData>\n";
  xml += appended_open;
  return xml;
}

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

// Hands `fill` a stream on a temporary file beside `path`, then gives the file its name.
template <class Fill>
void write_whole(const fs::path& path, Fill fill) {
  fs::path temporary = path;
  temporary += ".part";
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  if (!out) fail(path, "cannot be written: does its folder exist, and may it be written to?");
  fill(out);
  out.close();
  std::error_code error;
  if (!out) {
    fs::remove(temporary, error);
    fail(path, "cannot be written to the end: is the disk full?");
  }
  bring_to_disk(temporary);
  fs::rename(temporary, path, error);
  if (error) fail(path, "cannot be written: " + error.message());
}

template <class T>
void write_block(std::ostream& out, std::span<const T> values) {
  const BlockHeader bytes = values.size_bytes();
  out.write(reinterpret_cast<const char*>(&bytes), sizeof bytes);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(bytes));
}

void check_lengths(const ParticleSnapshot& s) {
  const std::size_t n = s.position_m.size();
  if (s.velocity_m_s.size() != n || s.pressure_Pa.size() != n || s.density_kg_m3.size() != n || s.id.size() != n)
    throw std::invalid_argument("snapshot: its arrays differ in length");
  if (s.fluid_count > n) throw std::invalid_argument("snapshot: more fluid particles than particles");
}

// The whole file's text up to and including the underscore that starts the appended data.
std::string read_header(const fs::path& path, std::ifstream& in) {
  std::string text(longest_header, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  if (text.find(signature) == std::string::npos)
    fail(path, "is not a snapshot written by sluice (version 1); only those are read");
  const std::size_t end = text.find(appended_open);
  if (end == std::string::npos) fail(path, "ends within its header: the file is cut short");
  text.resize(end + appended_open.size());
  return text;
}

template <class Number>
Number number_after(const fs::path& path, std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  Number value{};
  if (at == std::string_view::npos) fail(path, fmt::format("its header lacks {}", key));
  const char* first = text.data() + at + key.size();
  const auto [last, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error != std::errc{}) fail(path, fmt::format("its header has no number after {}", key));
  return value;
}

template <class T>
std::vector<T> read_block(const fs::path& path, std::ifstream& in, const ArrayLayout& array, std::size_t count) {
  BlockHeader bytes = 0;
  in.read(reinterpret_cast<char*>(&bytes), sizeof bytes);
  const std::uint64_t expected = payload_bytes(array, count);
  if (!in || bytes != expected)
    fail(path,
         fmt::format("array '{}' holds {} bytes where {} belong: the file is damaged", array.name, bytes, expected));
  std::vector<T> values(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes));
  if (!in) fail(path, fmt::format("ends within array '{}': the file is cut short", array.name));
  return values;
}

std::size_t leading_fluid(const fs::path& path, const std::vector<std::uint8_t>& kind) {
  const auto first_wall = std::find(kind.begin(), kind.end(), std::uint8_t{1});
  const bool ordered = std::all_of(kind.begin(), first_wall, [](std::uint8_t k) { return k == 0; }) &&
                       std::all_of(first_wall, kind.end(), [](std::uint8_t k) { return k == 1; });
  if (!ordered) fail(path, "array 'kind' is not fluid (0) first, then wall (1): the file is damaged");
  return static_cast<std::size_t>(first_wall - kind.begin());
}

void write_pvd(const fs::path& path, const std::vector<SnapshotEntry>& entries) {
  write_whole(path, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const SnapshotEntry& e : entries)
      out << fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", e.time_s,
                         e.file.generic_string());
    out << "  </Collection>\n</VTKFile>\n";
  });
}

}  // namespace

void write_vtp(const fs::path& path, const ParticleSnapshot& s) {
  check_lengths(s);
  const std::size_t n = s.position_m.size();
  std::vector<std::uint8_t> kind(n, 1);
  std::fill_n(kind.begin(), s.fluid_count, std::uint8_t{0});
  std::vector<std::int32_t> ordinal(n + 1);
  for (std::size_t i = 0; i <= n; ++i) ordinal[i] = static_cast<std::int32_t>(i);

  write_whole(path, [&](std::ostream& out) {  // in the order of `layout`
    out << header_xml(n, s.time_s);
    write_block(out, std::span<const Vec3<float>>(s.velocity_m_s));
    write_block(out, std::span<const float>(s.pressure_Pa));
    write_block(out, std::span<const float>(s.density_kg_m3));
    write_block(out, std::span<const std::int32_t>(s.id));
    write_block(out, std::span<const std::uint8_t>(kind));
    write_block(out, std::span<const Vec3<float>>(s.position_m));
    write_block(out, std::span<const std::int32_t>(ordinal).first(n));    // vertex cell i holds point i
    write_block(out, std::span<const std::int32_t>(ordinal).subspan(1));  // and ends before point i + 1
    out << appended_close;
  });
}

ParticleSnapshot read_vtp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be opened: no such file, or it may not be read");
  const std::string header = read_header(path, in);
  const auto n = number_after<std::size_t>(path, header, "NumberOfPoints=\"");
  ParticleSnapshot s;
  s.time_s = number_after<double>(path, header, "format=\"ascii\">");
  if (header != header_xml(n, s.time_s)) fail(path, "its header is not as sluice writes it: the file was changed");
  // Before any array is allotted: a damaged count must not ask for the machine's whole memory.
  const std::uint64_t expected = header.size() + block_offset(layout.size(), n) + appended_close.size();
  if (const std::uintmax_t size = fs::file_size(path); size != expected)
    fail(path, fmt::format("is {} bytes long where its header promises {}: the file is {}", size, expected,
                           size < expected ? "cut short" : "damaged"));

  in.seekg(static_cast<std::streamoff>(header.size()));
  s.velocity_m_s = read_block<Vec3<float>>(path, in, layout[0], n);
  s.pressure_Pa = read_block<float>(path, in, layout[1], n);
  s.density_kg_m3 = read_block<float>(path, in, layout[2], n);
  s.id = read_block<std::int32_t>(path, in, layout[3], n);
  s.fluid_count = leading_fluid(path, read_block<std::uint8_t>(path, in, layout[4], n));
  s.position_m = read_block<Vec3<float>>(path, in, layout[5], n);
  return s;
}

std::vector<SnapshotEntry> read_pvd(const fs::path& path) {
  std::ifstream in(path);
  if (!in) fail(path, "cannot be opened: no such file, or it may not be read");
  std::vector<SnapshotEntry> entries;
  bool closed = false;
  for (std::string line; std::getline(in, line);) {
    closed = closed || line == "</VTKFile>";
    if (line.find("<DataSet ") == std::string::npos) continue;
    constexpr std::string_view key = "file=\"";
    const std::size_t file = line.find(key);
    const std::size_t end = line.rfind('"');
    if (file == std::string::npos || end < file + key.size()) fail(path, "a DataSet line names no file");
    entries.push_back({number_after<double>(path, line, "timestep=\""),
                       path.parent_path() / line.substr(file + key.size(), end - file - key.size())});
  }
  if (!closed) fail(path, "is not a collection of snapshots written by sluice, or it is cut short");
  std::stable_sort(entries.begin(), entries.end(), [](auto& a, auto& b) { return a.time_s < b.time_s; });
  return entries;
}

SnapshotWriter::SnapshotWriter(fs::path run_directory) : run_directory_(std::move(run_directory)) {}

SnapshotWriter::SnapshotWriter(fs::path run_directory, std::size_t kept) : run_directory_(std::move(run_directory)) {
  if (kept == 0) return;
  const fs::path collection = run_directory_ / "snapshots.pvd";
  entries_ = read_pvd(collection);
  if (entries_.size() < kept)
    fail(collection, fmt::format("holds {} snapshots where {} were written", entries_.size(), kept));
  entries_.resize(kept);
  for (SnapshotEntry& entry : entries_) entry.file = fs::path("snapshots") / entry.file.filename();
}

fs::path SnapshotWriter::write(const ParticleSnapshot& snapshot) {
  std::error_code error;
  fs::create_directories(run_directory_ / "snapshots", error);
  if (error) fail(run_directory_ / "snapshots", "cannot be made: " + error.message());
  const fs::path file = fs::path("snapshots") / fmt::format("particles_{:04}.vtp", entries_.size());
  write_vtp(run_directory_ / file, snapshot);
  entries_.push_back({snapshot.time_s, file});
  bring_to_disk(run_directory_ / "snapshots");
  write_pvd(run_directory_ / "snapshots.pvd", entries_);
  return run_directory_ / file;
}

}  // namespace sluice
