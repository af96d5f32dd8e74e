#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// Sphere tree as the image stores it (see format::Node), over points in tree order.
struct SphereTree {
  std::vector<std::uint32_t> order;  ///< point i of the tree is the given point order[i]
  std::vector<format::Node> nodes;
};

/// Builds the tree. `levels`: the samples of hierarchy level 1, 2, .. as ascending indices into `points`. Each level
/// contains the one before it, and the last one contains all points. The parent of a sample is the nearest sample of
/// the level before, or itself if it is there. Spheres contain their points in double arithmetic and are minimal up to
/// the rounding of their numbers to float.
SphereTree build_sphere_tree(std::span<const Eigen::Vector3f> points,
                             const std::vector<std::vector<std::uint32_t>>& levels);

/// Sets the sphere of a node around these points: minimal up to the rounding of its numbers to float, never too small.
void set_sphere(std::span<const Eigen::Vector3d> points, format::Node& node);

/// Returns x[n], y[n], z[n] of values[order[0]], values[order[1]], ..
std::vector<float> by_axis(std::span<const Eigen::Vector3f> values, std::span<const std::uint32_t> order);

}  // namespace godobject::scene_compiler
