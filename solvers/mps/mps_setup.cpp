// Setting an MPS solver up: parameters checked, particles placed; and what it tells about itself.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solvers/mps/mps_solver.h"
#include "solvers/require.h"

namespace sluice::mps {
namespace {

/// How far particles may be displaced by the pressure correction before neighbours are searched anew, and the length of
/// a search slice, in particle distances.
constexpr double slack_over_distance = 0.025;
constexpr double slice_over_distance = 0.5;

Parameters checked(const Parameters& p) {
  require(p.particle_distance_m > 0, "particle_distance_m", p.particle_distance_m, "positive");
  require(p.effective_radius_over_distance >= 1.7 && p.effective_radius_over_distance <= 3,
          "effective_radius_over_distance", p.effective_radius_over_distance,
          "in [1.7, 3] (normals need neighbours out to 1.75 l0; walls have two layers of dummies)");
  require(p.viscosity_m2_s >= 0, "viscosity_m2_s", p.viscosity_m2_s, "zero or more");
  require(p.kappa_c_m_s2_kg > 0, "kappa_c_m_s2_kg", p.kappa_c_m_s2_kg, "positive");
  require(p.kappa_r > 0 && p.kappa_r <= 1, "kappa_r", p.kappa_r, "in (0, 1]");
  require(p.tolerated_crowding >= 0, "tolerated_crowding", p.tolerated_crowding,
          "zero or more (100 leaves kappa_r as it is)");
  require(p.courant > 0 && p.courant <= 1, "courant", p.courant, "in (0, 1]");
  require(p.greatest_speed_m_s > 0, "greatest_speed_m_s", p.greatest_speed_m_s, "positive");
  require(p.collision_over_distance >= 0 && p.collision_over_distance <= 1, "collision_over_distance",
          p.collision_over_distance, "in [0, 1]");
  require(p.wall_contact_over_distance >= 0 && p.wall_contact_over_distance <= 1, "wall_contact_over_distance",
          p.wall_contact_over_distance, "in [0, 1]");
  require(p.restitution >= 0 && p.restitution <= 1, "restitution", p.restitution, "in [0, 1]");
  require(p.tolerance > 0 && p.tolerance < 1, "tolerance", p.tolerance, "in (0, 1)");
  require(p.most_iterations >= 1, "most_iterations", p.most_iterations, "one or more");
  require(p.density_kg_m3 > 0, "density_kg_m3", p.density_kg_m3, "positive");
  return p;
}

double list_radius_m(const Parameters& p) {
  return p.effective_radius_m() + 2 * slack_over_distance * p.particle_distance_m;
}

/// Of the 32 neighbours of a full lattice 18 are near, with six sevenths of the weight.
double near_radius_m(const Parameters& p) {
  return std::min(p.effective_radius_m(), std::max(1.7 * p.particle_distance_m, collision_reach_m(p)));
}

RowGeometry rows(const Tank& tank, const Parameters& p) {
  const double l0 = p.particle_distance_m;
  return {tank.domain(), list_radius_m(p), slack_over_distance * l0, slice_over_distance * l0};
}

/// Which of Scene::walls are walls, or dummies.
std::vector<std::int32_t> solids_of(const Scene& scene, bool walls) {
  std::vector<std::int32_t> chosen;
  for (std::size_t k = 0; k < scene.walls.size(); ++k)
    if ((scene.walls[k].layer == 0) == walls) chosen.push_back(static_cast<std::int32_t>(k));
  return chosen;
}

}  // namespace

template <class Pack>
MpsSolver<Pack>::MpsSolver(const Scene& scene, const Parameters& parameters, int threads)
    : threads_(std::max(1, threads)),
      tank_(scene),
      constants_{
          checked(parameters),
          lattice_constants(parameters.particle_distance_m, parameters.effective_radius_m(), near_radius_m(parameters)),
          FixedPoint<typename Lanes<Pack>::Coordinate>::quantum_m(longest_edge(tank_.domain())),
          parameters.time_step_s()},
      reach_{constants_.quantum_m, parameters.effective_radius_m(), list_radius_m(parameters),
             near_radius_m(parameters)},
      fluid_index_(rows(tank_, parameters)),
      walls_(rows(tank_, parameters), solids_of(scene, true)),
      dummies_(rows(tank_, parameters), solids_of(scene, false)),
      moving_walls_(scene),
      pressure_equation_(constants_, reach_.near_radius_m, tank_.domain(), threads_) {
  if (scene.description.wall_layers < 3)
    throw std::invalid_argument(
        fmt::format("wall_layers = {}: MPS needs three layers, one of wall and two of dummy particles",
                    scene.description.wall_layers));
  place(scene);
}

template <class Pack>
void MpsSolver<Pack>::place(const Scene& scene) {
  particles_.resize(dummies_.walls.size(), walls_.walls.size(), scene.fluid.size());
  first_wall_id_ = static_cast<std::int32_t>(scene.fluid.size());
  walls_.first = particles_.first_wall();
  wall_place_.resize(scene.walls.size());
  for (const Solids* solids : {&dummies_, &walls_}) {
    for (std::size_t k = 0; k < solids->walls.size(); ++k) {
      const auto wall = static_cast<std::size_t>(solids->walls[k]);
      wall_place_[wall] = static_cast<std::int32_t>(solids->first + k);
      particles_.position.set(solids->first + k, scene.walls[wall].position);
      particles_.id[solids->first + k] = static_cast<std::int32_t>(scene.fluid.size() + wall);
    }
  }
  if (moving_walls_.any()) {
    moving_body_.resize(scene.walls.size());
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
      const int body = scene.walls[k].body;
      const bool moves = body > 0 && scene.fitted.obstacles[static_cast<std::size_t>(body) - 1].motion.moves();
      moving_body_[k] = static_cast<std::int8_t>(moves ? body : 0);
    }
  }
  set_moving_walls(0);
  sort_solids(dummies_);
  sort_solids(walls_);
  copy_wall_velocities();
  for (std::size_t k = 0; k < scene.fluid.size(); ++k) {
    particles_.position.set(particles_.first_fluid() + k, scene.fluid[k]);
    particles_.id[particles_.first_fluid() + k] = static_cast<std::int32_t>(k);
  }
  particles_.encode_positions(tank_.domain(), 0, threads_);
  wall_normals_.resize(particles_.walls);
  find_normals(tank_.domain());
  list_neighbours();
}

template <class Pack>
void MpsSolver<Pack>::set_velocity(std::int32_t id, const Vec3d& velocity_m_s) {
  const auto found = std::find(particles_.id.begin(), particles_.id.end(), id);
  const auto i = static_cast<std::size_t>(found - particles_.id.begin());
  if (found == particles_.id.end() || !particles_.is_fluid(i))
    throw std::invalid_argument(fmt::format("no fluid particle has the id {}", id));
  particles_.velocity.set(i, velocity_m_s);
}

template <class Pack>
std::int64_t MpsSolver<Pack>::memory_bytes() const {
  return particles_.memory_bytes() + fluid_index_.memory_bytes() + walls_.memory_bytes() + dummies_.memory_bytes() +
         bytes(wall_place_) + list_.memory_bytes() + pressure_equation_.memory_bytes() + bytes(next_velocity_) +
         bytes(listed_) + bytes(wall_normals_) + bytes(leaves_);
}

template <class Pack>
std::map<std::string, double> MpsSolver<Pack>::facts() const {
  const auto per = [](std::int64_t sum, std::int64_t n) {
    return n > 0 ? static_cast<double>(sum) / static_cast<double>(n) : 0.0;
  };
  return {{"dt_s", constants_.dt_s},
          {"n0", constants_.lattice.number_density},
          {"lambda0_m2", constants_.lattice.lambda_m2},
          {"iterations_mean", per(iterations_, steps_)},
          {"iterations_max", static_cast<double>(most_iterations_)},
          {"unknowns", static_cast<double>(unknowns_)},
          {"multigrid_levels", static_cast<double>(pressure_equation_.levels())},
          {"number_density_max_over_n0", greatest_density_ratio_},
          {"collisions_share", per(collisions_, fluid_steps_)},
          {"plain_gradients_share", per(plain_gradients_, fluid_steps_)},
          {"negative_pressures_set_to_zero_per_step", per(negative_pressures_, steps_)},
          {"lanes", static_cast<double>(Lanes<Pack>::width)}};
}

template class MpsSolver<FloatPack>;
template class MpsSolver<double>;

}  // namespace sluice::mps

namespace sluice {

std::unique_ptr<Solver> make_mps_solver(const Scene& scene, const mps::Parameters& parameters, int threads) {
  return std::make_unique<mps::MpsSolver<FloatPack>>(scene, parameters, threads);
}

}  // namespace sluice
