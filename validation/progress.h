// Tells a person how a run goes: one line that is rewritten on a terminal, plain lines now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace sluice {

/// Writes for people and flushes. A terminal that has gone or a disk that is full is no reason to stop computing:
/// errors are ignored.
void tell(std::FILE* stream, const std::string& text);

/// Where a run stands.
struct RunState {
  double time_s = 0;
  std::int64_t steps = 0;
  double dt_s = 0;
  double particle_steps = 0;  ///< since the start
  double elapsed_s = 0;       ///< wall time of stepping
};

/// "t = 0.412 / 6 s, step 3211, dt = 1.1e-04 s, 5.9 M particle-steps/s, 2 min 10 s left": rate and remaining time by
/// what the run did after `since`, an earlier state of it (by the whole run where nothing came after it).
std::string progress_text(const RunState& state, double t_end_s, const RunState& since = {});

class Progress {
 public:
  /// `stream` may be nullptr: then nothing is written.
  Progress(std::FILE* stream, bool terminal, double t_end_s);

  /// Cheap enough for every time step; writes only when something is due (every 0.2 s on a terminal, otherwise
  /// every 5 % of the run, but not within 10 s of the last line nor later than 60 s after it). Returns the text when a
  /// plain line was due, for the log. Rates are those of the last one to two minutes since this object began: a run
  /// that was resumed, or that shared the machine for a while, says how it goes now.
  std::string update(const RunState& state);
  /// Ends the terminal's line, so that what follows starts on its own.
  void finish(const RunState& state);

 private:
  std::FILE* stream_;
  bool terminal_;
  double t_end_s_;
  double last_terminal_s_ = 0;
  double last_plain_s_ = 0;
  double last_plain_time_s_ = 0;
  bool begun_ = false;
  RunState since_;   ///< what rates are counted from
  RunState recent_;  ///< takes its place when it is a minute old
};

}  // namespace sluice
