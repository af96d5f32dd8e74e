#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// Sphere tree as the image holds it (see format::Node) over points in tree order.
struct SphereTree {
  std::vector<std::uint32_t> order;  ///< the tree's point i is the point order[i] given
  std::vector<format::Node> nodes;
};

/// `levels`: the samples of hierarchy level 1, 2, .. as ascending indices into `points`, each level containing the one
/// before it and the last all points. Every sample hangs on the nearest one of the level before; itself if it is there.
/// Spheres hold their points in double arithmetic and are minimal up to the rounding of their numbers to float.
SphereTree build_sphere_tree(std::span<const Eigen::Vector3f> points,
                             const std::vector<std::vector<std::uint32_t>>& levels);

/// The sphere of a node that holds these points: minimal up to the rounding of its numbers to float, never too small.
void set_sphere(std::span<const Eigen::Vector3d> points, format::Node& node);

/// x[n], y[n], z[n] of values[order[0]], values[order[1]], ..
std::vector<float> by_axis(std::span<const Eigen::Vector3f> values, std::span<const std::uint32_t> order);

}  // namespace godobject::scene_compiler
