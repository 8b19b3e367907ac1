#include "ci/ledger.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <set>
#include <stdexcept>

#include "validation/file_error.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum class Access { read, append };

/// An open, locked ledger; what is written to it appears whole or not at all.
class LockedFile {
 public:
  LockedFile(fs::path path, Access access) : path_(std::move(path)) {
    const bool append = access == Access::append;
    std::error_code ignored;
    if (append && path_.has_parent_path()) fs::create_directories(path_.parent_path(), ignored);
    descriptor_ = ::open(path_.c_str(), O_CLOEXEC | (append ? O_RDWR | O_CREAT | O_APPEND : O_RDONLY), 0644);
    if (descriptor_ < 0) fail(path_, fmt::format("cannot be opened: {}", std::strerror(errno)));
    while (::flock(descriptor_, append ? LOCK_EX : LOCK_SH) != 0) {
      if (errno == EINTR) continue;
      const int error = errno;
      ::close(descriptor_);
      fail(path_, fmt::format("cannot be locked: {}", std::strerror(error)));
    }
  }
  ~LockedFile() { ::close(descriptor_); }  // and with it the lock
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  void add(std::string text) {
    const off_t end = ::lseek(descriptor_, 0, SEEK_END);
    // A line that somebody did not finish must not swallow the next.
    if (char last = '\n'; end > 0 && ::pread(descriptor_, &last, 1, end - 1) == 1 && last != '\n') text = "\n" + text;
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written == static_cast<ssize_t>(text.size()) && ::fsync(descriptor_) == 0) return;
    const int error = written >= 0 && written < static_cast<ssize_t>(text.size()) ? ENOSPC : errno;
    if (::ftruncate(descriptor_, end) != 0)
      fail(path_, fmt::format("could be written in part only, and not be taken back: {}", std::strerror(error)));
    fail(path_, fmt::format("cannot be written: {} (the ledger is as it was)", std::strerror(error)));
  }

 private:
  fs::path path_;
  int descriptor_ = -1;
};

/// Reads fields of one line; every error names the key.
class Line {
 public:
  explicit Line(const json& object) : object_(object) {}

  std::string text(const char* key) const { return as<std::string>(key, at(key).is_string(), "text"); }
  std::string date(const char* key) const {
    std::string value = text(key);
    if (!is_date(value)) throw std::runtime_error(fmt::format("{}: is not a date such as 2026-11-25T09:34:08Z", key));
    return value;
  }
  double number(const char* key) const { return as<double>(key, at(key).is_number(), "a number"); }
  int whole(const char* key) const { return as<int>(key, at(key).is_number_integer(), "a whole number"); }
  bool flag(const char* key) const { return as<bool>(key, at(key).is_boolean(), "true or false"); }
  std::optional<double> number_or_null(const char* key) const {
    return at(key).is_null() ? std::nullopt : std::optional(number(key));
  }
  const json& object(const char* key) const {
    if (!at(key).is_object()) throw std::runtime_error(fmt::format("{}: is not an object", key));
    return at(key);
  }

 private:
  const json& at(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) throw std::runtime_error(fmt::format("{}: is missing", key));
    return *found;
  }
  template <class T>
  T as(const char* key, bool fits, const char* what) const {
    if (!fits) throw std::runtime_error(fmt::format("{}: is not {}", key, what));
    return at(key).get<T>();
  }

  const json& object_;
};

Result result_of(const Line& line) {
  Result r;
  r.date = line.date("date");
  r.commit = line.text("commit");
  r.machine = line.text("machine");
  r.compiler = line.text("compiler");
  r.flags = line.text("flags");
  r.threads = line.whole("threads");
  r.inputs = line.text("inputs");
  r.case_name = line.text("case");
  r.solver = line.text("solver");
  r.parameters = line.object("parameters");
  r.metric = line.text("metric");
  r.of = line.text("of");
  r.value = line.number_or_null("value");
  r.unit = line.text("unit");
  r.run = line.text("run");
  r.link = line.text("link");
  if (!r.value) r.reason = line.text("reason");
  return r;
}

Acceptance acceptance_of(const Line& line) {
  return {line.date("date"),         line.text("by"),           line.text("series"), line.date("first_date"),
          line.text("first_commit"), line.number("difference"), line.text("reason"), line.flag("scatter")};
}

void read_line(const std::string& text, Ledger& ledger) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded()) throw std::runtime_error("is not JSON");
  if (!object.is_object()) throw std::runtime_error("is not a JSON object");
  const Line line(object);
  if (const int schema = line.whole("schema"); schema < 1 || schema > ledger_schema)
    throw std::runtime_error(
        fmt::format("schema {} is unknown to this program, which reads up to {}", schema, ledger_schema));
  const std::string kind = line.text("kind");
  if (kind == "result")
    ledger.results.push_back(result_of(line));
  else if (kind == "acceptance")
    ledger.acceptances.push_back(acceptance_of(line));
  else
    throw std::runtime_error(fmt::format("kind: unknown kind `{}`", kind));
}

/// Of a file that this process has locked: a second lock of its own would wait for the first for ever.
Ledger read_locked(const fs::path& file) {
  Ledger ledger;
  std::ifstream in(file);
  if (!in || fs::is_directory(file)) fail(file, "cannot be read");
  std::int64_t number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    if (text.empty()) continue;
    try {
      read_line(text, ledger);
    } catch (const std::exception& error) {
      ledger.damaged.push_back({number, error.what()});
    }
  }
  if (in.bad()) fail(file, "cannot be read to its end");
  return ledger;
}

std::string bytes_to_line(const json& object) {
  // Text that is not UTF-8 must not cost a night's results.
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string to_line(const Result& r) {
  if (r.value && !std::isfinite(*r.value))
    throw std::invalid_argument(fmt::format("{} {}: the value is not finite", r.metric, r.of));
  json line = {{"schema", ledger_schema}, {"kind", "result"},     {"date", r.date},
               {"commit", r.commit},      {"machine", r.machine}, {"compiler", r.compiler},
               {"flags", r.flags},        {"threads", r.threads}, {"inputs", r.inputs},
               {"case", r.case_name},     {"solver", r.solver},   {"parameters", r.parameters},
               {"metric", r.metric},      {"of", r.of},           {"value", json(nullptr)},
               {"unit", r.unit},          {"run", r.run},         {"link", r.link}};
  if (r.value)
    line["value"] = *r.value;
  else
    line["reason"] = r.reason;
  return bytes_to_line(line);
}

std::string to_line(const Acceptance& a) {
  return bytes_to_line({{"schema", ledger_schema},
                        {"kind", "acceptance"},
                        {"date", a.date},
                        {"by", a.by},
                        {"series", a.series},
                        {"first_date", a.first_date},
                        {"first_commit", a.first_commit},
                        {"difference", a.difference},
                        {"reason", a.reason},
                        {"scatter", a.scatter}});
}

Ledger read_ledger(const fs::path& file) {
  if (!fs::exists(file)) return {};
  const LockedFile locked(file, Access::read);
  return read_locked(file);
}

Appended append_results(const fs::path& file, std::span<const Result> results) {
  LockedFile locked(file, Access::append);
  std::set<std::string> known;
  for (const Result& there : read_locked(file).results) known.insert(there.run);
  Appended appended;
  std::set<std::string> met;
  std::string lines;
  for (const Result& result : results) {
    if (known.contains(result.run)) {
      met.insert(result.run);
      continue;
    }
    lines += to_line(result) + '\n';
    ++appended.results;
  }
  appended.known_runs = met.size();
  if (!lines.empty()) locked.add(std::move(lines));
  return appended;
}

void append_acceptances(const fs::path& file, std::span<const Acceptance> acceptances) {
  std::string lines;
  for (const Acceptance& acceptance : acceptances) lines += to_line(acceptance) + '\n';
  if (!lines.empty()) LockedFile(file, Access::append).add(std::move(lines));
}

bool is_date(const std::string& text) {
  static const std::string form = "dddd-dd-ddTdd:dd:ddZ";
  if (text.size() != form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == 'd' ? text[i] < '0' || text[i] > '9' : text[i] != form[i]) return false;
  std::tm parts{};
  return strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) != nullptr;
}

double days_of(const std::string& date) {
  std::tm parts{};
  strptime(date.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return static_cast<double>(timegm(&parts)) / 86400;
}

}  // namespace sluice::ci
