#include "bench/pair_costs.h"

// First, so that the terms' templates find its functions beside those of lanes.h.
#include "bench/operation_count.h"
#include "solvers/mps/terms.h"
#include "solvers/vec3.h"
#include "solvers/wcsph/kernel.h"
#include "solvers/wcsph/terms.h"

namespace sluice::bench {
namespace {

using R = CountingReal;
using V = Vec3<R>;

const R some(0.5);
const V here{some, some, some};
const V there = here;

/// What a loop over pairs has of a pair before its terms: pairs() in solvers/wcsph/neighbour_packs.h.
struct Pair {
  V r = here - there;
  R distance2 = dot(r, r);
  R taper = wcsph::wendland_taper(square_root(distance2), some);
};

struct Terms {
  R g;
  R approach;
  V momentum;
};

/// pair_terms() in fluid_sums.cpp, and the momentum from it.
Terms terms_of(const Pair& p) {
  const R g = wcsph::wendland_gradient_shape(p.taper);
  const R approach = dot(here - there, p.r);
  const auto viscosity = wcsph::artificial_viscosity(approach, p.distance2, some, some + some, some + some);
  larger(magnitude(viscosity.mu), some);
  const R pressure = larger(some, some);
  const R force = wcsph::momentum_term(some, pressure, some, some, some * viscosity.Pi, g);
  return {g, approach, force * p.r};
}

}  // namespace

double operations_of_fluid_pair() {
  return count_operations([] {
    const Pair p;
    const Terms t = terms_of(p);
    V sum = here;
    sum += t.momentum;
    V other = here;
    other += V{-t.momentum.x, -t.momentum.y, -t.momentum.z};
    const R continuity = wcsph::continuity_term(t.g, t.approach);
    R continuity_sum;
    continuity_sum += continuity;
    R diffusion_sum;
    diffusion_sum += wcsph::diffusion_term(some, some, some, t.g);
    R rate_of_other;
    rate_of_other += some * continuity + some * wcsph::diffusion_term(some, some, some, t.g);
  });
}

double operations_of_fluid_and_wall() {
  return count_operations([] {
    const Pair p;
    const Terms t = terms_of(p);
    V sum = here;
    sum += t.momentum;
    R continuity;
    continuity += wcsph::continuity_term(t.g, t.approach);
  });
}

double operations_of_extrapolated_pressure() {
  return count_operations([] {
    const Pair p;
    const R W = wcsph::wendland_weight(p.taper, some);
    R weights;
    weights += W;
    R pressures;
    pressures += W * wcsph::extrapolated_pressure(some, some + some, here, V{-p.r.x, -p.r.y, -p.r.z});
  });
}

double operations_of_wall_continuity() {
  return count_operations([] {
    const Pair p;
    R sum;
    sum += wcsph::continuity_term(wcsph::wendland_gradient_shape(p.taper), dot(here - there, p.r));
  });
}

double operations_of_listed_neighbour() {
  return count_operations([] {
    const V r = here - there;
    const R w = mps::weight(square_root(dot(r, r)), some);
    R sum;
    sum += w;
    V moments = here;
    moments += w * r;
  });
}

double operations_of_viscosity_term() {
  return count_operations([] {
    const V r = here - there;
    const R omega = mps::weight(square_root(dot(r, r)), some);
    V laplacian = here;
    laplacian += V{mps::laplacian_term(some, some, omega), mps::laplacian_term(some, some, omega),
                   mps::laplacian_term(some, some, omega)};
  });
}

double operations_of_gradient_term() {
  return count_operations([] {
    smaller(some, some);  // of the least pressure
    const V r = here - there;
    const R distance2 = dot(r, r);
    V sum = here;
    sum += mps::gradient_term(some, some, r, distance2, some);
    mps::Symmetric3<R> matrix;
    matrix += mps::correction_term(r, distance2, some);
  });
}

double operations_of_collision_test() {
  return count_operations([] {
    const V r = here - there;
    const V relative = here - there;
    const V ahead = r + some * relative;
    dot(ahead, ahead);
  });
}

}  // namespace sluice::bench
