#include "validation/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/plan.h"

namespace sluice {
namespace {

constexpr double terminal_interval_s = 0.2;
constexpr double plain_interval_s = 10;
constexpr double longest_plain_interval_s = 60;
constexpr double plain_share = 0.05;
constexpr double rate_window_s = 60;

}  // namespace

void tell(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);  // fmt::print would throw
  std::fflush(stream);
}

std::string progress_text(const RunState& state, double t_end_s, const RunState& since) {
  const bool moved = state.elapsed_s > since.elapsed_s && state.time_s > since.time_s;
  const RunState from = moved ? since : RunState{};
  const double elapsed_s = state.elapsed_s - from.elapsed_s;
  const double time_s = state.time_s - from.time_s;
  const double rate = elapsed_s > 0 ? (state.particle_steps - from.particle_steps) / elapsed_s : 0;
  const double left_s = time_s > 0 ? elapsed_s * (t_end_s - state.time_s) / time_s : HUGE_VAL;
  return fmt::format("t = {:.3f} / {:g} s, step {}, dt = {:.2e} s, {:.2f} M particle-steps/s, {} left", state.time_s,
                     t_end_s, state.steps, state.dt_s, rate / 1e6, human_time(std::max(0.0, left_s)));
}

Progress::Progress(std::FILE* stream, bool terminal, double t_end_s)
    : stream_(stream), terminal_(terminal), t_end_s_(t_end_s) {}

std::string Progress::update(const RunState& state) {
  if (!begun_) since_ = recent_ = state;
  begun_ = true;
  if (state.elapsed_s - recent_.elapsed_s >= rate_window_s) {
    since_ = recent_;
    recent_ = state;
  }
  if (stream_ != nullptr && terminal_ && state.elapsed_s - last_terminal_s_ >= terminal_interval_s) {
    last_terminal_s_ = state.elapsed_s;
    // Blanks at the end cover what a longer line left behind.
    tell(stream_, fmt::format("\r{:<100}", progress_text(state, t_end_s_, since_)));
  }
  const double since_last_s = state.elapsed_s - last_plain_s_;
  const bool due = since_last_s >= longest_plain_interval_s ||
                   (since_last_s >= plain_interval_s && state.time_s - last_plain_time_s_ >= plain_share * t_end_s_);
  if (!due) return "";
  last_plain_s_ = state.elapsed_s;
  last_plain_time_s_ = state.time_s;
  std::string text = progress_text(state, t_end_s_, since_);
  if (stream_ != nullptr && !terminal_) tell(stream_, text + "\n");
  return text;
}

void Progress::finish(const RunState& state) {
  if (stream_ == nullptr || !terminal_) return;
  tell(stream_, fmt::format("\r{:<100}\n", progress_text(state, t_end_s_)));
}

}  // namespace sluice
