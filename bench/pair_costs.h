// Floating-point operations of one pair in each loop over pairs, as those loops put the terms together.
#pragma once

namespace sluice::bench {

// WCSPH (solvers/wcsph/fluid_sums.cpp and wall_sums.cpp)
double operations_of_fluid_pair();             ///< both of its particles get their sums
double operations_of_fluid_and_wall();         ///< one-sided
double operations_of_extrapolated_pressure();  ///< a wall particle and a fluid one
double operations_of_wall_continuity();        ///< likewise

// MPS (solvers/mps/neighbours.cpp, operators.cpp and collisions.cpp), for an entry of a row
double operations_of_listed_neighbour();
double operations_of_viscosity_term();
double operations_of_gradient_term();
double operations_of_collision_test();  ///< pairs of fluid that do not collide, as nearly all

}  // namespace sluice::bench
