#include "bench/prepared_run.h"

#include <cmath>
#include <utility>

#include "validation/manifest.h"
#include "validation/solver_factory.h"

namespace sluice::bench {
namespace {

constexpr double jitter_over_distance = 0.2;

Scene disordered_scene(const Case& c, const RunSettings& settings, double jitter) {
  Scene scene = build_scene(scene_description(c, settings));
  disorder(scene, jitter);
  return scene;
}

}  // namespace

void disorder(Scene& scene, double jitter) {
  std::uint32_t state = 12345;
  const auto displacement_m = [&] {
    state = state * 1664525U + 1013904223U;
    return jitter * scene.description.particle_distance_m * (2.0 * (state >> 8) / 16777216.0 - 1);
  };
  for (Vec3d& x : scene.fluid)
    for (double* coordinate : {&x.x, &x.y, &x.z}) *coordinate += displacement_m();
}

double particle_distance_m(const Case& c, double fluid_particles) {
  double volume_m3 = 0;
  for (const Box& box : scene_description(c, 0.02, 3).fluid) {
    const Vec3d edge = box.upper - box.lower;
    volume_m3 += edge.x * edge.y * edge.z;
  }
  return std::cbrt(volume_m3 / fluid_particles);
}

PreparedRun::PreparedRun(Case the_case, RunSettings run_settings, double jitter)
    : c(std::move(the_case)),
      settings(std::move(run_settings)),
      scene(disordered_scene(c, settings, jitter)),
      solver(make_solver(c, scene, settings)),
      sensors(c, scene, solver->smoothing_length_m(), settings.solver, settings.walls) {}

PreparedRun prepare(const std::string& solver, const std::string& walls, double fluid_particles, int threads) {
  const Case c = load_case("kleefsman");
  RunRequest request;
  request.solver = solver;
  request.walls = walls;
  request.l0_m = particle_distance_m(c, fluid_particles);
  request.threads = threads;
  return {c, resolve_settings(c, request), jitter_over_distance};
}

std::map<std::string, std::string> provenance() {
  const BuildInfo& build = build_info();
  return {{"machine", machine_fingerprint()},
          {"cpu", cpu_model()},
          {"commit", build.commit},
          {"compiler", build.compiler},
          {"flags", build.flags}};
}

StepMeter::StepMeter(const Solver& solver)
    : solver_(solver),
      phases_(solver.phases()),
      steps_(static_cast<double>(solver.steps())),
      time_s_(solver.time_s()),
      iterations_(iterations(solver)),
      cpu_s_(cpu_time_s()),
      start_(std::chrono::steady_clock::now()) {}

StepMeter::Reading StepMeter::read() const {
  Reading r;
  r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  r.cpu_s = cpu_time_s() - cpu_s_;
  r.steps = static_cast<double>(solver_.steps()) - steps_;
  r.simulated_s = solver_.time_s() - time_s_;
  if (r.steps > 0) r.iterations_a_step = (iterations(solver_) - iterations_) / r.steps;
  for (const auto& [phase, total_s] : solver_.phases()) {
    const auto earlier = phases_.find(phase);
    r.phases[phase] = total_s - (earlier == phases_.end() ? 0 : earlier->second);
  }
  return r;
}

double StepMeter::iterations(const Solver& solver) {
  const std::map<std::string, double> facts = solver.facts();
  const auto mean = facts.find("iterations_mean");
  return mean == facts.end() ? 0 : mean->second * static_cast<double>(solver.steps());
}

}  // namespace sluice::bench
