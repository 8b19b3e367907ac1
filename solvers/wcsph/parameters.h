// The parameters of the WCSPH solver, with the paper's values as defaults, but for the restart interval, the limit of
// tension and the walls. Not a parameter, and not in the paper: density does not fall below m W(0), that of a particle
// which is alone.
#pragma once

#include <string>

#include "solvers/vec3.h"

namespace sluice::wcsph {

/// How walls act on the fluid.
enum class WallModel {
  dynamic,       ///< one layer that integrates density like fluid (Crespo et al. 2007), as in the paper
  extrapolated,  ///< three layers that carry the fluid's extrapolated pressure (Adami, Hu and Adams 2012)
};

struct Parameters {
  double particle_distance_m = 0;            ///< l0
  double kernel_radius_over_distance = 3.0;  ///< 2h / l0
  double alpha = 0.01;                       ///< artificial viscosity
  double delta = 0.1;                        ///< density diffusion
  double gamma = 7.0;                        ///< exponent of the Tait equation; the solver requires 7
  double courant = 0.2;                      ///< Cr
  double speed_of_sound_m_s = 0;             ///< c0 = 20 sqrt(g H_W)
  double reference_density_kg_m3 = 1000;     ///< rho_0
  double water_height_m = 0;                 ///< H_W: the still level of the hydrostatic start
  Vec3d gravity_m_s2{0, 0, -9.81};
  /// N_s: steps between restart forms of the Verlet scheme. The paper's 40 lets the scheme's odd-even mode grow:
  /// density diffusion damps at about 7 delta c0 / h, the leap turns that into growth, and at delta = 0.1 and Cr = 0.2
  /// forty steps multiply the mode more than a restart takes from it, so that a still tank comes to the boil in two
  /// seconds. Twenty do not (wcsph_verification_test.cpp shows both, without a tension limit, which holds the mode down
  /// too).
  int restart_interval = 20;
  /// The greatest tension of the fluid over rho_0 c_0^2: a hundredth goes with the hundredth by which the speed of
  /// sound lets the density vary. The equation of state allows 1/7: a knot of spray draws itself together with it until
  /// the time step collapses, and long before that it sets every step. 1, as in the paper: no limit.
  double tension_limit = 0.01;
  /// Share of the artificial viscosity that acts between fluid and walls: 1 as between fluid particles, 0 slip (which
  /// the project's cases choose with extrapolated walls).
  double wall_friction = 1;
  WallModel walls = WallModel::extrapolated;

  /// Below it the equation of state is cut off   [Pa]
  double least_pressure_Pa() const {
    return -tension_limit * reference_density_kg_m3 * speed_of_sound_m_s * speed_of_sound_m_s;
  }
  double smoothing_length_m() const { return 0.5 * kernel_radius_over_distance * particle_distance_m; }
};

}  // namespace sluice::wcsph
