#include "solvers/leaving.h"

#include <fmt/format.h>

#include <stdexcept>

namespace sluice {

LostParticles find_leaving(const Tank& tank, const VectorField<double>& position_m, std::size_t first,
                           std::vector<std::uint8_t>& leaves, const Solver& solver, int threads) {
  const auto n = static_cast<std::int64_t>(leaves.size());
  std::int64_t over_top = 0;
  std::int64_t through_walls = 0;
  std::int64_t undefined = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(+ : over_top, through_walls, undefined)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Whereabouts w = tank.whereabouts(position_m.at<double>(first + i));
    leaves[i] = static_cast<std::uint8_t>(w);
    over_top += w == Whereabouts::over_top;
    through_walls += w == Whereabouts::through_wall;
    undefined += w == Whereabouts::undefined;
  }
  if (undefined > 0) {
    throw std::runtime_error(
        fmt::format("{} particles have positions that are no numbers after step {} (t = {:.6f} s): the run has become "
                    "unstable; try a smaller Courant number",
                    undefined, solver.steps(), solver.time_s()));
  }
  return {over_top, through_walls};
}

}  // namespace sluice
