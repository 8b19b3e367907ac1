// The kernels of an MPS step, each alone, on the particles of a disordered dam break.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/pair_costs.h"
#include "bench/prepared_run.h"
#include "bench/suite.h"
#include "solvers/mps/collisions.h"
#include "solvers/mps/mps_solver.h"

namespace sluice::bench {
namespace {

using Solver = mps::MpsSolver<FloatPack>;

constexpr int steps_before = 3;  // so that pressures are those of a run

/// A solver after a few steps, a copy of its particles with fresh neighbours, and the pressure equation's matrix.
struct State {
  State(double particles, int thread_count)
      : run(prepare("mps", "dummies", particles, thread_count)),
        solver(dynamic_cast<Solver&>(*run.solver)),
        threads(thread_count),
        index(solver.fluid_set().index.geometry()),
        equation(solver.constants(), solver.reach().near_radius_m, index.geometry().domain, thread_count),
        multigrid(index.geometry().domain, 2 * run.settings.l0_m, thread_count) {
    for (int k = 0; k < steps_before; ++k) solver.step();
    particles_ = solver.particles();
    stays.assign(particles_.fluid, 0);
    velocity.resize(particles_.size());
    constants = solver.constants();
    sort();
    list_rows();
    equation.assemble(particles_, list);
    multigrid.prepare(equation.matrix(), particles_.position.x, particles_.position.y, particles_.position.z);
  }

  void sort() {
    const auto fluid = [&](const std::vector<double>& v) {
      return std::span<const double>(v).subspan(particles_.first_fluid());
    };
    const auto& x = particles_.position;
    index.sort(fluid(x.x), fluid(x.y), fluid(x.z), stays, threads);
    particles_.permute_fluid(index.order(), threads);
    particles_.encode_positions(index.geometry().domain, particles_.first_fluid(), threads);
  }
  void list_rows() {
    list.list(particles_, {index, particles_.first_fluid()}, solver.wall_set(), solver.dummy_set(), solver.reach(),
              threads);
  }
  double fluid() const { return static_cast<double>(particles_.fluid); }

  PreparedRun run;
  Solver& solver;
  int threads;
  RowIndex index;
  mps::PressureEquation<FloatPack> equation;
  mps::Multigrid<float> multigrid;
  mps::OperatorConstants constants;
  mps::Particles<FloatPack> particles_;
  mps::NeighbourList<FloatPack> list;
  VectorField<float> velocity;
  std::vector<std::uint8_t> stays;
};

/// Particles first .. end - 1 that have entries, and the number of those.
struct Rows {
  double filled = 0;
  double entries = 0;
};
template <class Count>
Rows rows(std::size_t first, std::size_t end, Count&& count) {
  Rows r;
  for (std::size_t i = first; i < end; ++i) {
    const std::uint32_t n = count(i);
    r.filled += n > 0;
    r.entries += n;
  }
  return r;
}
std::uint32_t length(mps::Span s) {
  return s.end - s.begin;
}
Rows rows_of_fluid(const State& s) {
  return rows(s.particles_.first_fluid(), s.particles_.size(), [&](std::size_t i) { return s.list.count(i); });
}

constexpr double entry = 8;  // bytes: a column and a weight
constexpr double coordinates = 12;

Kernel sort(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  // As for WCSPH; carried are positions (24), a velocity (12), the pressure (8), two sums (8) and the id (4), and the
  // coordinates (12) are written.
  const double bytes = s->fluid() * (24 + 1 + 16 + 2 * (24 + 12 + 8 + 8 + 4) + 24 + 12);
  return {[s] { s->sort(); }, {s->fluid(), bytes, 0}};
}

Kernel neighbour_rows(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const auto& p = s->particles_;
  const Rows all = rows(p.first_wall(), p.size(), [&](std::size_t i) { return s->list.count(i); });
  // Of every particle its position and coordinates, of every row two spans (16), four sums (16) and a count (2).
  const auto n = static_cast<double>(p.size());
  const double bytes = n * (24 + coordinates) + all.filled * 34 + all.entries * entry;
  return {[s] { s->list_rows(); }, {s->fluid(), bytes, all.entries * operations_of_listed_neighbour()}};
}

Kernel viscosity(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const Rows r = rows_of_fluid(*s);
  // Columns, not weights; velocities are read and predicted ones written; of walls and dummies what is near the fluid
  // is left out.
  const double bytes = r.entries * 4 + s->fluid() * (8 + coordinates + 12 + 12);
  return {[s] { predict_velocities(s->particles_, s->list, s->constants, s->velocity, s->threads); },
          {s->fluid(), bytes, r.entries * operations_of_viscosity_term()}};
}

Kernel collisions(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const auto& p = s->particles_;
  const Rows near = rows(p.first_fluid(), p.size(), [&](std::size_t i) { return length(s->list.near().span(i)); });
  const double bytes = near.entries * 4 + s->fluid() * (8 + 24 + 12 + 12);
  return {[s] { collide(s->particles_, s->solver.normals_of_walls(), s->list, s->constants, s->velocity, s->threads); },
          {s->fluid(), bytes, near.entries * operations_of_collision_test()}};
}

/// With a time step of length zero, so that every call finds the same particles.
Kernel pressure_gradients(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  s->constants.dt_s = 0;
  const auto& p = s->particles_;
  const Rows r = rows(p.first_fluid(), p.size(), [&](std::size_t i) {
    return length(s->list.near().span(i)) + length(s->list.far_with_pressure(i));
  });
  // Entries; coordinates and pressure (8) read, positions (24) and velocities (12) read and written.
  const double bytes = r.entries * entry + s->fluid() * (8 + coordinates + 8 + 48 + 24);
  return {[s] { correct(s->particles_, s->list, s->constants, s->threads); },
          {s->fluid(), bytes, r.entries * operations_of_gradient_term()}};
}

/// y = A x as conjugate gradients take it: weights in single precision, vectors in double. Items are unknowns.
Kernel matrix_product(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const auto& A = s->equation.matrix();
  const auto x = std::make_shared<std::vector<double>>(A.end, 0.0);
  const auto y = std::make_shared<std::vector<double>>(A.end, 0.0);
  for (std::size_t i = A.begin; i < A.end; ++i) (*x)[i] = A.has_row[i] != 0 ? std::sin(static_cast<double>(i)) : 0.0;
  const Rows r = rows(A.begin, A.end, [&](std::size_t i) {
    return A.has_row[i] != 0 ? length(A.near.rows[i]) + length(A.far.rows[i]) : 0U;
  });
  // A row: two spans (16), diagonal (4), flag (1), one element of each vector (16). Two operations an entry and on the
  // diagonal.
  const double bytes = r.entries * entry + r.filled * (16 + 4 + 1 + 16);
  const auto multiply = [s, x, y] {
    const auto& M = s->equation.matrix();
    const auto end = static_cast<std::int64_t>(M.end);
#pragma omp parallel for num_threads(s->threads) schedule(static, 512)
    for (auto k = static_cast<std::int64_t>(M.begin); k < end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      (*y)[i] = product(M, i, x->data());
    }
  };
  return {multiply, {r.filled, bytes, 2 * r.entries + 2 * r.filled}};
}

/// Bytes and operations of one V-cycle (below the finest level a W-cycle). A visit of a level smooths from zero: b and
/// diagonal read, x written (12), one division. Each visit from there to the next level takes the residual and hands it
/// down: entries, span, b, x, diagonal, scratch written and read, cell (36), two operations an entry and three an
/// unknown; and comes back with a correction: x, cell, scratch written and read, entries, span, b, diagonal, x written
/// (40), two operations an entry and four an unknown. The coarsest level's direct solution is left out.
Work cycle_work(const std::vector<mps::LevelSize>& levels) {
  Work work;
  double arrivals = 1;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    const auto unknowns = static_cast<double>(levels[l].unknowns);
    const auto entries = static_cast<double>(levels[l].entries);
    const double descents = arrivals * (l == 0 ? 1 : 2);
    work.bytes += arrivals * 12 * unknowns + descents * (2 * entries * entry + (36 + 40) * unknowns);
    work.operations += arrivals * unknowns + descents * (4 * entries + 7 * unknowns);
    arrivals = descents;
  }
  work.items = static_cast<double>(levels.front().unknowns);
  return work;
}

/// The preconditioner of one iteration. Items are unknowns.
Kernel v_cycle(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  return {[s] { s->multigrid.apply(s->equation.right_side()); }, cycle_work(s->multigrid.level_sizes())};
}

/// Coarse cells and matrices of one step.
Kernel multigrid_setup(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  return {[s] {
            const auto& x = s->particles_.position;
            s->multigrid.prepare(s->equation.matrix(), x.x, x.y, x.z);
          },
          {static_cast<double>(s->multigrid.level_sizes().front().unknowns), 0, 0}};
}

/// The whole pressure equation of a step, always from the pressures of the step before.
Kernel pressure_equation(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const auto first_guess = std::make_shared<const std::vector<double>>(s->particles_.pressure);
  return {[s, first_guess] {
            std::copy(first_guess->begin(), first_guess->end(), s->particles_.pressure.begin());
            s->equation.solve(s->particles_, s->list);
          },
          {s->fluid(), 0, 0}};
}

/// One reading of all sensors of the case; an item is a reading of one of them.
Kernel sensors(double particles, int threads) {
  const auto s = std::make_shared<State>(particles, threads);
  const auto values = std::make_shared<std::vector<double>>();
  return {[s, values] { s->run.sensors.sample(s->solver, *values); },
          {static_cast<double>(s->run.sensors.placed().size()), 0, 0}};
}

}  // namespace

void add_mps_kernels(const SuiteOptions& options) {
  add_kernel("mps/sort", options, sort);
  add_kernel("mps/neighbour_rows", options, neighbour_rows);
  add_kernel("mps/viscosity", options, viscosity);
  add_kernel("mps/collisions", options, collisions);
  add_kernel("mps/matrix_product", options, matrix_product);
  add_kernel("mps/multigrid_setup", options, multigrid_setup);
  add_kernel("mps/v_cycle", options, v_cycle);
  add_kernel("mps/pressure_equation", options, pressure_equation);
  add_kernel("mps/pressure_gradients", options, pressure_gradients);
  add_kernel("mps/sensors", options, sensors);
}

}  // namespace sluice::bench
