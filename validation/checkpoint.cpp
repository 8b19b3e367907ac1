#include "validation/checkpoint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "solvers/bring_to_disk.h"
#include "solvers/state_archive.h"
#include "validation/file_error.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "sluice checkpoint";
constexpr const char* remedy = "start the run anew with `sluice run ... --force`, or put an older copy in its place";

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& o) noexcept : id_(std::exchange(o.id_, -1)), close_(o.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t type_of<char>() {
  return H5T_NATIVE_CHAR;
}

/// One dataset a value, checksummed (Fletcher 32) so that damage does not pass for a state.
class FileArchive final : public StateArchive {
 public:
  FileArchive(fs::path path, hid_t file, bool restoring) : path_(std::move(path)), file_(file), restoring_(restoring) {}

  bool restoring() const override { return restoring_; }
  void value(const std::string& name, double& v) override { move(name, std::span(&v, 1)); }
  void value(const std::string& name, std::int64_t& v) override { move(name, std::span(&v, 1)); }
  void values(const std::string& name, std::span<double> v) override { move(name, v); }
  void values(const std::string& name, std::span<float> v) override { move(name, v); }
  void values(const std::string& name, std::span<std::int32_t> v) override { move(name, v); }

  template <class T>
  void write(const std::string& name, std::span<T> v) {
    const auto n = static_cast<hsize_t>(v.size());
    const hsize_t chunk = std::max<hsize_t>(1, std::min<hsize_t>(n, 1 << 18));
    const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
    const Handle settings(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(settings, 1, &chunk);
    H5Pset_fletcher32(settings);
    const Handle set(H5Dcreate2(file_, name.c_str(), type_of<T>(), space, H5P_DEFAULT, settings, H5P_DEFAULT),
                     H5Dclose);
    if (!set.valid() || (n > 0 && H5Dwrite(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, v.data()) < 0))
      fail(path_, fmt::format("{} cannot be put into the checkpoint (out of memory?)", name));
  }

  template <class T>
  std::size_t length(const Handle& set) const {
    const Handle space(H5Dget_space(set), H5Sclose);
    return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  }

  template <class T>
  void read(const std::string& name, const Handle& set, std::span<T> v) const {
    if (length<T>(set) != v.size())
      fail(path_, fmt::format("{} has {} values where {} belong: it is of another case or resolution; {}", name,
                              length<T>(set), v.size(), remedy));
    if (!v.empty() && H5Dread(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, v.data()) < 0)
      fail(path_, fmt::format("{} cannot be read: the file is damaged; {}", name, remedy));
  }

  template <class T>
  Handle open(const std::string& name) const {
    Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set.valid()) fail(path_, fmt::format("holds no {}: it is of another version or damaged; {}", name, remedy));
    const Handle type(H5Dget_type(set), H5Tclose);
    if (H5Tequal(type, type_of<T>()) <= 0) fail(path_, fmt::format("{} is of another type; {}", name, remedy));
    return set;
  }

 private:
  template <class T>
  void move(const std::string& name, std::span<T> v) {
    if (restoring_) {
      read(name, open<T>(name), v);
    } else {
      write(name, v);
    }
  }

  fs::path path_;
  hid_t file_;
  bool restoring_;
};

/// The file's bytes, made in memory: a file that HDF5 itself cannot bring to a full disk stays open in the library for
/// good.
std::vector<std::byte> file_image(const fs::path& file, const nlohmann::json& header, Solver& solver) {
  constexpr std::size_t increment = std::size_t{16} << 20;
  const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(in_memory, increment, false);
  const Handle h5(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose);
  if (!h5.valid()) fail(file, "cannot be made in memory");
  FileArchive archive(file, h5, false);
  std::string identity = fmt::format("{} {}", format_name, checkpoint_schema);
  std::string text = header.dump();
  archive.write("format", std::span(identity));
  archive.write("header", std::span(text));
  solver.visit_state(archive);
  const ssize_t size = H5Fflush(h5, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(h5, nullptr, 0);
  if (size <= 0) fail(file, "cannot be made in memory");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  if (H5Fget_file_image(h5, image.data(), image.size()) != size) fail(file, "cannot be made in memory");
  return image;
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : id_(::open(path.c_str(), flags, 0644)) {}
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int id() const { return id_; }

 private:
  int id_;
};

[[noreturn]] void fail_with_cause(const fs::path& path, const char* what) {
  fail(path, fmt::format("{} ({}); free space on that disk or write to another one", what,
                         std::generic_category().message(errno)));
}

void write_file(const fs::path& file, std::span<const std::byte> image) {
  const Descriptor out(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
  if (out.id() < 0) fail_with_cause(file, "cannot be made");
  while (!image.empty()) {
    const ssize_t written = ::write(out.id(), image.data(), image.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_with_cause(file, "cannot be written");
    image = image.subspan(static_cast<std::size_t>(written));
  }
  bring_to_disk(file);
}

std::string text_of(const FileArchive& archive, const std::string& name) {
  const Handle set = archive.open<char>(name);
  std::string text(archive.length<char>(set), ' ');
  archive.read(name, set, std::span(text));
  return text;
}

/// Opens a checkpoint and makes sure that it is one.
Handle open_file(const fs::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told by exceptions, not on stderr
  if (!fs::exists(file)) fail(file, "no such file: this run left no checkpoint; start it anew with `sluice run`");
  if (const Descriptor readable(file, O_RDONLY | O_CLOEXEC); readable.id() < 0)
    fail(file, fmt::format("cannot be opened ({}); check its permissions and the disk",
                           std::generic_category().message(errno)));
  if (H5Fis_hdf5(file.c_str()) <= 0) fail(file, fmt::format("is no HDF5 file, or cut short; {}", remedy));
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);  // RunLock keeps others out, also where the file system knows no locks
  Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!h5.valid()) fail(file, fmt::format("cannot be opened: it is cut short or damaged; {}", remedy));
  const FileArchive archive(file, h5, true);
  const std::string identity = H5Lexists(h5, "format", H5P_DEFAULT) > 0 ? text_of(archive, "format") : "";
  if (!identity.starts_with(format_name)) fail(file, fmt::format("is an HDF5 file, but no checkpoint; {}", remedy));
  if (identity != fmt::format("{} {}", format_name, checkpoint_schema))
    fail(file,
         fmt::format("is of another version ({}; this program reads {}); {}", identity, checkpoint_schema, remedy));
  return h5;
}

}  // namespace

void write_checkpoint(const fs::path& file, const nlohmann::json& header, Solver& solver) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const fs::path part = file.string() + ".part";
  try {
    write_file(part, file_image(file, header, solver));
    fs::rename(part, file);
    bring_to_disk(fs::absolute(file).parent_path());  // a rename is there when its folder is
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

nlohmann::json read_checkpoint_header(const fs::path& file) {
  const Handle h5 = open_file(file);
  try {
    return nlohmann::json::parse(text_of(FileArchive(file, h5, true), "header"));
  } catch (const nlohmann::json::exception& error) {
    fail(file, fmt::format("its header cannot be understood ({}); {}", error.what(), remedy));
  }
}

void restore_checkpoint(const fs::path& file, Solver& solver) {
  const Handle h5 = open_file(file);
  FileArchive archive(file, h5, true);
  solver.visit_state(archive);
}

}  // namespace sluice
