#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "solvers/bring_to_disk.h"
#include "validation/series.h"

namespace sluice {

namespace {

constexpr std::size_t buffer_limit_bytes = 1 << 20;
constexpr std::chrono::seconds flush_interval{1};

std::string header_line(const std::vector<std::string>& names) {
  std::string line = "t_s";
  for (const auto& name : names) line += "," + name;
  return line;
}

std::FILE* open_for_writing(const std::filesystem::path& path, const char* mode) {
  std::FILE* file = std::fopen(path.c_str(), mode);
  if (file == nullptr) {
    throw std::runtime_error(fmt::format("{}: cannot be written ({}); check that its folder exists and is writable",
                                         path.string(), std::generic_category().message(errno)));
  }
  // Rows are gathered in a buffer, so that each write to the file ends with a whole row.
  std::setvbuf(file, nullptr, _IONBF, 0);
  return file;
}

/// Cuts the file back to where it was.
void cut_back(const std::filesystem::path& path, const std::string& header, const ProbeWriter::Position& position) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::string first_line;
  std::getline(std::ifstream(path) >> std::ws, first_line);
  if (error || size < position.bytes || first_line != header) {
    throw std::runtime_error(fmt::format(
        "{}: cannot be continued: it should hold {} bytes under the columns of this run, but {} (start the run anew "
        "with `sluice run ... --force`)",
        path.string(), position.bytes,
        error                   ? "cannot be read"
        : size < position.bytes ? fmt::format("holds {}", size)
                                : "has other columns"));
  }
  std::filesystem::resize_file(path, position.bytes);
}

}  // namespace

ProbeWriter::ProbeWriter(std::filesystem::path path, std::vector<std::string> names)
    : path_(std::move(path)), names_(std::move(names)), last_flush_(std::chrono::steady_clock::now()) {
  file_ = open_for_writing(path_, "wb");
  buffer_ = header_line(names_);
  buffer_ += '\n';
  try {
    flush();
  } catch (...) {
    if (file_) std::fclose(std::exchange(file_, nullptr));
    throw;
  }
}

ProbeWriter::ProbeWriter(std::filesystem::path path, std::vector<std::string> names, const Position& from)
    : path_(std::move(path)),
      names_(std::move(names)),
      bytes_on_disk_(from.bytes),
      last_flush_(std::chrono::steady_clock::now()),
      last_t_s_(from.last_t_s),
      rows_(from.rows) {
  cut_back(path_, header_line(names_), from);
  file_ = open_for_writing(path_, "ab");
}

ProbeWriter::~ProbeWriter() {
  try {
    close();
  } catch (const std::exception&) {
    // Whoever wants to know calls close().
  }
}

void ProbeWriter::append(double t_s, std::span<const double> values) {
  if (!file_) throw std::logic_error(fmt::format("{}: a row after the file was closed", path_.string()));
  if (values.size() != names_.size()) {
    throw std::invalid_argument(
        fmt::format("{}: {} values for {} columns", path_.string(), values.size(), names_.size()));
  }
  if (!std::isfinite(t_s) || (rows_ > 0 && t_s <= last_t_s_)) {
    throw std::invalid_argument(fmt::format("{}: time {} s after {} s", path_.string(), t_s, last_t_s_));
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) {
      throw std::runtime_error(
          fmt::format("{}: {} is {} at t = {} s: the simulation has diverged; rows up to then are kept", path_.string(),
                      names_[k], values[k], t_s));
    }
  }
  // Nine digits carry every single-precision value; times need more to stay apart.
  fmt::format_to(std::back_inserter(buffer_), "{:.12g}", t_s);
  for (const double value : values) fmt::format_to(std::back_inserter(buffer_), ",{:.9g}", value);
  buffer_ += '\n';
  last_t_s_ = t_s;
  ++rows_;
  if (!flush_is_due()) return;
  try {
    flush();
  } catch (const std::runtime_error&) {
    if (std::chrono::steady_clock::now() - trouble_since_ > patience) throw;
  }
}

bool ProbeWriter::flush_is_due() const {
  return buffer_.size() > buffer_limit_bytes || std::chrono::steady_clock::now() - last_flush_ > flush_interval;
}

void ProbeWriter::flush() {
  if (!file_ || buffer_.empty()) return;
  write_buffer();
  buffer_.clear();
  trouble_.clear();
  last_flush_ = std::chrono::steady_clock::now();
}

void ProbeWriter::flush_to_disk() {
  flush();
  if (file_) bring_to_disk(path_);
}

void ProbeWriter::write_buffer() {
  const auto written = std::fwrite(buffer_.data(), 1, buffer_.size(), file_);
  if (written == buffer_.size()) {
    bytes_on_disk_ += written;
    return;
  }
  const int cause = errno;
  // Half a row would make the whole file unreadable: cut back to what was complete.
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) std::filesystem::resize_file(path_, bytes_on_disk_, ignored);
  std::clearerr(file_);
  std::fseek(file_, 0, SEEK_END);
  if (trouble_.empty()) trouble_since_ = std::chrono::steady_clock::now();
  trouble_ = fmt::format(
      "{}: cannot be written ({}); free space on that disk or write to another one (rows up to byte {} are kept)",
      path_.string(), std::generic_category().message(cause), bytes_on_disk_);
  throw std::runtime_error(trouble_);
}

void ProbeWriter::close() {
  if (!file_) return;
  try {
    flush();
  } catch (...) {
    std::fclose(std::exchange(file_, nullptr));
    throw;
  }
  if (std::fclose(std::exchange(file_, nullptr)) != 0) {
    throw std::runtime_error(fmt::format("{}: cannot be closed ({}); check the disk", path_.string(),
                                         std::generic_category().message(errno)));
  }
}

}  // namespace sluice
