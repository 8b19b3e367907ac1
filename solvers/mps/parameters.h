// What a run of the MPS solver is given. Defaults are the paper's where it has the parameter: tolerated crowding,
// collisions, contacts with walls and multigrid are this project's, and that what has four neighbours or fewer lies at
// the free surface (pressure_equation.cpp).
#pragma once

#include "solvers/vec3.h"

namespace sluice::mps {

enum class Preconditioner { jacobi, multigrid };

struct Parameters {
  double particle_distance_m = 0.02;            ///< l0
  double effective_radius_over_distance = 2.1;  ///< r_e / l0
  double viscosity_m2_s = 1e-6;                 ///< nu
  double kappa_c_m_s2_kg = 1e-8;                ///< artificial compressibility, Eq. (23)
  double kappa_r = 0.01;                        ///< relaxation of the source term, Eq. (23)
  double tolerated_crowding = 0.15;             ///< of n_i / n0 above 1, before the source gets stronger (relaxation())
  double courant = 0.2;
  double greatest_speed_m_s = 5;        ///< |u|max of the time step, Eq. (27)
  double least_density_ratio = 0.98;    ///< beta_1: a surface particle has n_i < beta_1 n0, Eq. (28)
  double centroid_over_distance = 0.2;  ///< varrho_1: and sigma_i > varrho_1 l0, Eq. (29)
  /// Pairs closer than this that approach collide (see collisions.h); 0 turns collisions off, as in the paper's text.
  double collision_over_distance = 0.85;
  double restitution = 0.2;                 ///< of a collision
  double wall_contact_over_distance = 0.5;  ///< fluid comes no closer to the wall's layer (see collisions.h); 0: off
  Preconditioner preconditioner = Preconditioner::multigrid;
  double tolerance = 1e-6;  ///< of the pressure equation's residual over its right-hand side
  int most_iterations = 1000;
  double density_kg_m3 = 1000;
  Vec3d gravity_m_s2{0, 0, -9.81};

  double effective_radius_m() const { return effective_radius_over_distance * particle_distance_m; }
  /// dt = Cr l0 / |u|max   [s]   Eq. (27)
  double time_step_s() const { return courant * particle_distance_m / greatest_speed_m_s; }
};

}  // namespace sluice::mps
