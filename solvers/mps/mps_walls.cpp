// Walls and dummy particles: their sorted order, and bodies that move.
#include <optional>

#include "solvers/mps/mps_solver.h"

namespace sluice::mps {

/// From the order of Scene::walls, so that the sorted order at a time does not depend on the sorts before. Returns
/// which of the solids each one was.
template <class Pack>
std::vector<std::int32_t> MpsSolver<Pack>::sort_solids(Solids& solids) {
  std::vector<std::int32_t> now;
  for (const std::int32_t wall : solids.walls) now.push_back(static_cast<std::int32_t>(place_of(wall)));
  VectorField<double> position;
  gather(particles_.position, now, position);
  solids.index.sort(position.x, position.y, position.z, {}, threads_);
  std::vector<std::int32_t> from;
  for (const std::int32_t k : solids.index.order())
    from.push_back(now[static_cast<std::size_t>(k)] - static_cast<std::int32_t>(solids.first));
  particles_.permute(solids.first, from);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto wall = static_cast<std::size_t>(solids.walls[static_cast<std::size_t>(solids.index.order()[k])]);
    wall_place_[wall] = static_cast<std::int32_t>(solids.first + k);
  }
  solids.proximity = Proximity(solids.index);
  return from;
}

/// Returns a box around the moving particles where they were and are.
template <class Pack>
Box MpsSolver<Pack>::set_moving_walls(double t_s) {
  std::optional<Box> moved;
  const auto include = [&](const Vec3d& x) { moved = moved ? around(*moved, {x, x}) : Box{x, x}; };
  tank_.move_obstacles(t_s);
  moving_walls_.for_each(t_s, [&](std::int32_t wall, const Vec3d& position, const Vec3d& velocity) {
    include(particles_.position.template at<double>(place_of(wall)));
    include(position);
    particles_.position.set(place_of(wall), position);
    particles_.velocity.set(place_of(wall), velocity);
  });
  return moved.value_or(Box{});
}

/// Bodies with a prescribed motion go to where they are at a time, and all walls into their order there.
template <class Pack>
void MpsSolver<Pack>::bring_walls_to(double t_s) {
  const Box moved = set_moving_walls(t_s);
  sort_solids(dummies_);
  std::vector<double> spare;
  gather(wall_normals_, sort_solids(walls_), spare, threads_);
  copy_wall_velocities();
  find_normals(moved);
  particles_.encode_positions(tank_.domain(), 0, threads_);
}

/// Predictions and collisions write the fluid's velocities into a second array, which then takes the place of the
/// first: both have to hold those of the walls.
template <class Pack>
void MpsSolver<Pack>::copy_wall_velocities() {
  next_velocity_.resize(particles_.size());
  for (std::size_t i = 0; i < particles_.first_fluid(); ++i)
    next_velocity_.set(i, particles_.velocity.template at<double>(i));
}

template <class Pack>
void MpsSolver<Pack>::find_normals(const Box& moved) {
  std::vector<std::int8_t> moving_body;
  if (moving_walls_.any())
    for (std::size_t w = 0; w < particles_.walls; ++w)
      moving_body.push_back(
          moving_body_[static_cast<std::size_t>(particles_.id[particles_.first_wall() + w] - first_wall_id_)]);
  find_wall_normals(particles_, {dummies_.index, walls_.index, moving_body}, constants_.parameters.particle_distance_m,
                    moved, threads_, wall_normals_);
}

template class MpsSolver<FloatPack>;
template class MpsSolver<double>;

}  // namespace sluice::mps
