// The ledger: one file that only grows, one JSON object a line, of what was measured at which commit.
//
//   {"schema":1,"kind":"result","date":"2026-11-25T09:34:08Z","commit":"da6b460ba876","machine":"AMD EPYC, 2 cores",
//    "compiler":"g++ 12.2.0","flags":"-O3","threads":2,"inputs":"fnv1a64:..","case":"kleefsman","solver":"mps",
//    "parameters":{"l0_m":0.02,"walls":"dummies"},"metric":"impulse_deviation","of":"P1 nearest","value":-0.046,
//    "unit":"1","run":"8a6d..","link":"runs/nightly/k20"}
//   {"schema":1,"kind":"acceptance","date":"..","by":"..","series":"1f3a9c04","first_date":"..","first_commit":"..",
//    "difference":0.02,"reason":"..","scatter":false}
//
// ci/README.md explains every field. Writers take an exclusive lock (flock), readers a shared one; lines are added by
// a single write, and what cannot be written in full is taken back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sluice::ci {

inline constexpr int ledger_schema = 1;
/// In the place of a case where a benchmark was measured.
inline const std::string benchmark_case = "benchmark";

/// One value of one metric.
struct Result {
  std::string date;    ///< when the run began, UTC, as 2026-11-25T09:34:08Z
  std::string commit;  ///< as the run's manifest has it; "-dirty" at its end for uncommitted changes
  std::string machine;
  std::string compiler;
  std::string flags;
  int threads = 0;     ///< 0: not stated
  std::string inputs;  ///< hash of the case file and the measured data; empty when not stated
  std::string case_name;
  std::string solver;
  nlohmann::json parameters = nlohmann::json::object();  ///< what tells runs of one case and solver apart
  std::string metric;
  std::string of;               ///< of what: sensor and model, phase, benchmark; empty for the whole run
  std::optional<double> value;  ///< none: the run should have given it and did not, see `reason`
  std::string unit;             ///< SI; "1" for pure numbers
  std::string run;              ///< the same for all results of one run
  std::string link;             ///< where the run can be looked at
  std::string reason;           ///< why there is no value
};

/// A shift that people know of and live with.
struct Acceptance {
  std::string date;
  std::string by;
  std::string series;        ///< SeriesKey::id()
  std::string first_date;    ///< of the first result at the new level
  std::string first_commit;  ///< its commit
  double difference = 0;     ///< new level - old level
  std::string reason;
  bool scatter = false;  ///< the shift means nothing (another order of rounding): later ones must be larger
};

struct DamagedLine {
  std::int64_t line = 0;  ///< from 1 on
  std::string problem;
};

struct Ledger {
  std::vector<Result> results;  ///< in the file's order
  std::vector<Acceptance> acceptances;
  std::vector<DamagedLine> damaged;  ///< left out
};

/// Reads a ledger; lines that cannot be used are listed in `damaged`. A file that does not exist is an empty ledger.
/// Throws std::runtime_error when the file cannot be read.
Ledger read_ledger(const std::filesystem::path& file);

struct Appended {
  std::size_t results = 0;
  std::size_t known_runs = 0;  ///< runs that the ledger has already: none of their results is added again
};

/// Adds results, all or none. Creates the file and its directory. Throws std::runtime_error naming the file: no
/// permission, full disk (the file then is as it was).
Appended append_results(const std::filesystem::path& file, std::span<const Result> results);
void append_acceptances(const std::filesystem::path& file, std::span<const Acceptance> acceptances);

/// One line, without its end. Throws std::invalid_argument for a value that is not finite.
std::string to_line(const Result& result);
std::string to_line(const Acceptance& acceptance);

/// Whether a text is a date as the ledger has it.
bool is_date(const std::string& text);
/// Days since 1970-01-01 of such a date, with its fraction.
double days_of(const std::string& date);

}  // namespace sluice::ci
