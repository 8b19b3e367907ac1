#include "validation/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/run_lock.h"
#include "validation/solver_factory.h"

namespace sluice {
namespace {

// Memory beside the solver's: the scene (positions in double precision) while the solver is set up; later, in its
// place, the checkpoint, of which there are two copies while it is written; and what the process itself takes.
constexpr double scene_bytes_per_particle = 40;
constexpr double checkpoint_bytes_per_fluid_particle = 2 * 90;
constexpr double checkpoint_bytes_per_solid_particle = 2 * 8;
constexpr std::int64_t process_bytes = 64 << 20;

std::int64_t memory_for(const ParticleCounts& n, double bytes_per_particle) {
  const auto fluid = static_cast<double>(n.fluid);
  const auto solid = static_cast<double>(n.solid);
  const double beside =
      std::max((fluid + solid) * scene_bytes_per_particle,
               fluid * checkpoint_bytes_per_fluid_particle + solid * checkpoint_bytes_per_solid_particle);
  const double bytes = (fluid + solid) * bytes_per_particle + beside;
  return static_cast<std::int64_t>(std::min(bytes, 9e18)) + process_bytes;
}

// Smallest particle distance, in steps of 2 %, whose memory fits; rounded up to three figures for people.
double fitting_l0_m(const Case& c, const RunSettings& settings, std::int64_t available_bytes) {
  double l0_m = settings.l0_m;
  const double bytes = solver_cost(settings).bytes_per_particle;
  while (l0_m < 1) {
    l0_m *= 1.02;
    if (!particle_distance_problem(c, l0_m).empty()) return 0;
    if (memory_for(count_particles(scene_description(c, l0_m, settings.wall_layers)), bytes) <= available_bytes) break;
  }
  const double scale = std::pow(10, 2 - std::floor(std::log10(l0_m)));
  return std::ceil(l0_m * scale) / scale;
}

/// Where a plan's time comes from, for people.
const char* told_by(PlanBasis basis) {
  switch (basis) {
    case PlanBasis::run:
      return "by a run of its kind on this machine";
    case PlanBasis::probe:
      return "by a second of its first steps: no run of its kind on this machine yet";
    case PlanBasis::constants:
      break;
  }
  return "no run of its kind on this machine yet";
}

}  // namespace

Plan plan_run(const Case& c, const RunSettings& settings) {
  Plan plan;
  plan.particles = count_particles(scene_description(c, settings));
  const SolverCost cost = solver_cost(settings);
  plan.memory_bytes = memory_for(plan.particles, cost.bytes_per_particle);
  plan.dt_s = cost.dt_s;
  plan.steps = std::ceil(settings.t_end_s / plan.dt_s);
  plan.wall_time_s =
      static_cast<double>(plan.particles.fluid) * plan.steps / (cost.fluid_steps_per_s_and_thread * settings.threads);
  return plan;
}

void refuse_if_too_large(const Case& c, const RunSettings& settings, const Plan& plan,
                         std::optional<std::int64_t> available_bytes, bool begun) {
  if (!available_bytes || plan.memory_bytes <= *available_bytes) return;
  const double l0_m = begun ? 0 : fitting_l0_m(c, settings, *available_bytes);
  const std::string remedy = begun      ? "free some memory, or go on with it where there is more"
                             : l0_m > 0 ? fmt::format("use --l0 {:g} or more, or free some memory", l0_m)
                                        : "free some memory: the coarsest particles that resolve the case do not fit "
                                          "either";
  throw NotNow(fmt::format("l0 = {:g} m needs about {} of memory, {} are available ({})", settings.l0_m,
                           human_bytes(static_cast<double>(plan.memory_bytes)),
                           human_bytes(static_cast<double>(*available_bytes)), remedy));
}

std::string describe(const Plan& plan, std::optional<std::int64_t> available_bytes) {
  const std::string available =
      available_bytes ? human_bytes(static_cast<double>(*available_bytes)) : std::string("unknown");
  return fmt::format(
      "particles: {} fluid, {} solid; memory: about {} (available: {})\n"
      "expected: {:.0f} steps of {:.3g} s, about {} ({})\n",
      plan.particles.fluid, plan.particles.solid, human_bytes(static_cast<double>(plan.memory_bytes)), available,
      plan.steps, plan.dt_s, human_time(plan.wall_time_s), told_by(plan.basis));
}

std::string human_bytes(double bytes) {
  if (bytes >= 1e9) return fmt::format("{:.1f} GB", bytes / 1e9);
  if (bytes >= 1e6) return fmt::format("{:.0f} MB", bytes / 1e6);
  return fmt::format("{:.0f} kB", bytes / 1e3);
}

std::string human_time(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  const auto s = static_cast<long long>(std::llround(std::min(seconds, 1e12)));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  if (s < 86400) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
  return fmt::format("{} d {:02} h", s / 86400, s / 3600 % 24);
}

}  // namespace sluice
