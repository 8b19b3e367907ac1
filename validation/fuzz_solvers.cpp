// In the place of the solvers, for the fuzzers: they read what is to be computed and compute nothing.
#include <cstdlib>

#include "solvers/mps/mps_solver.h"
#include "solvers/wcsph/wcsph_solver.h"

namespace sluice {

std::unique_ptr<Solver> make_wcsph_solver(const Scene&, const wcsph::Parameters&, int) {
  std::abort();
}

std::unique_ptr<Solver> make_mps_solver(const Scene&, const mps::Parameters&, int) {
  std::abort();
}

}  // namespace sluice
