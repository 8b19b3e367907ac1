// What a run will cost, told before it starts: particles, memory, steps and time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "solvers/scene.h"
#include "validation/case.h"
#include "validation/run_settings.h"

namespace sluice {

/// Where a plan's time comes from.
enum class PlanBasis {
  constants,  ///< this program's, of the machine on which they were measured
  probe,      ///< a second of first steps on this machine (rate_probe.h)
  run,        ///< a run of the same kind on this machine (run_cost.h)
};

struct Plan {
  ParticleCounts particles;  ///< beyond 2e7 from volumes and areas, good to a few per cent
  std::int64_t memory_bytes = 0;
  double dt_s = 0;
  double steps = 0;
  double wall_time_s = 0;
  PlanBasis basis = PlanBasis::constants;  ///< of the time
};

/// Throws std::invalid_argument when the geometry cannot be built at this particle distance.
Plan plan_run(const Case& c, const RunSettings& settings);

/// Throws NotNow (run_lock.h) when the plan does not fit; the message names the particle distance that would, but for a
/// run that was begun elsewhere and keeps its own.
void refuse_if_too_large(const Case& c, const RunSettings& settings, const Plan& plan,
                         std::optional<std::int64_t> available_bytes, bool begun = false);

/// Two lines for people.
std::string describe(const Plan& plan, std::optional<std::int64_t> available_bytes);

/// "1.5 GB", "3 min 20 s": for people, two or three figures.
std::string human_bytes(double bytes);
std::string human_time(double seconds);

}  // namespace sluice
