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

}  // namespace

void tell(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);  // fmt::print would throw
  std::fflush(stream);
}

std::string progress_text(const RunState& state, double t_end_s) {
  const double rate = state.elapsed_s > 0 ? state.particle_steps / state.elapsed_s : 0;
  const double left_s = state.time_s > 0 ? state.elapsed_s * (t_end_s - state.time_s) / state.time_s : HUGE_VAL;
  return fmt::format("t = {:.3f} / {:g} s, step {}, dt = {:.2e} s, {:.2f} M particle-steps/s, {} left", state.time_s,
                     t_end_s, state.steps, state.dt_s, rate / 1e6, human_time(std::max(0.0, left_s)));
}

Progress::Progress(std::FILE* stream, bool terminal, double t_end_s)
    : stream_(stream), terminal_(terminal), t_end_s_(t_end_s) {}

std::string Progress::update(const RunState& state) {
  if (stream_ != nullptr && terminal_ && state.elapsed_s - last_terminal_s_ >= terminal_interval_s) {
    last_terminal_s_ = state.elapsed_s;
    // Blanks at the end cover what a longer line left behind.
    tell(stream_, fmt::format("\r{:<100}", progress_text(state, t_end_s_)));
  }
  const double since_last_s = state.elapsed_s - last_plain_s_;
  const bool due = since_last_s >= longest_plain_interval_s ||
                   (since_last_s >= plain_interval_s && state.time_s - last_plain_time_s_ >= plain_share * t_end_s_);
  if (!due) return "";
  last_plain_s_ = state.elapsed_s;
  last_plain_time_s_ = state.time_s;
  std::string text = progress_text(state, t_end_s_);
  if (stream_ != nullptr && !terminal_) tell(stream_, text + "\n");
  return text;
}

void Progress::finish(const RunState& state) {
  if (stream_ == nullptr || !terminal_) return;
  tell(stream_, fmt::format("\r{:<100}\n", progress_text(state, t_end_s_)));
}

}  // namespace sluice
