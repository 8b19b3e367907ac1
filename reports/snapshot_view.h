// Particles as a picture: an oblique view from the near side wall, the right and from above, so that the face of the
// box on which the water runs is seen; far particles first, hidden ones left out.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "solvers/snapshot.h"
#include "validation/case.h"

namespace sluice {

/// A disc of the drawing, in metres of the drawing plane; colour as 0xRRGGBB.
struct SnapshotDisc {
  float x = 0;
  float y = 0;
  std::uint32_t colour = 0;
};

/// Where a point of space falls in the drawing plane.
std::pair<double, double> project(const Vec3d& point);
/// How far behind the drawing plane a point lies (larger is farther).
double depth(const Vec3d& point);

/// Perceptually uniform colours, told apart with every common colour blindness: viridis (van der Walt and Smith 2015).
/// `share` outside 0..1 takes the end's colour.
std::uint32_t viridis(double share);

/// What colours particles: P* = P / (rho g H_W) or v* = |u| / sqrt(g H_W), from 0 to `largest`.
struct ParticleColour {
  enum class Of { pressure, velocity } of = Of::pressure;
  double largest = 1;
};

/// The fluid and the walls of obstacles, far to near. Walls are grey, or coloured where pressed when pressure is shown.
/// Discs that nearer ones hide wholly are left out.
std::vector<SnapshotDisc> snapshot_discs(const ParticleSnapshot& snapshot, const Case& the_case, double l0_m,
                                         ParticleColour colour);

/// Where an obstacle is at a time, cut off at the tank's open top; nullopt when it has left the tank.
std::optional<Box> obstacle_at(const Obstacle& obstacle, double t_s, const Box& tank);

/// Edges of a box in the drawing plane, as pairs of ends.
std::vector<std::pair<std::pair<double, double>, std::pair<double, double>>> box_edges(const Box& box);

}  // namespace sluice
