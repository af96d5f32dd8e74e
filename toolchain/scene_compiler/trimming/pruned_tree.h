#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// Points that a scene image holds: x[n], y[n], z[n] in tree order, their normals likewise or none, their sphere tree.
struct TreeOfPoints {
  std::vector<float>& points;
  std::vector<float>& normals;
  std::vector<format::Node>& nodes;
};

/// As leave_out_points; returns how many levels there are, the points' own included.
std::uint32_t prune(const std::vector<bool>& stays, const TreeOfPoints& tree);

/// Leaves out points with stays[i] false; one stays at least. The others keep their order and their bits, so that what
/// is summed over them does. Nodes without a point go, and a node with one child only gives way to it: there are less
/// than twice as many nodes as points. Spheres shrink to what they hold. `header`, a Body or Features, counts it.
template <class Header>
void leave_out_points(const std::vector<bool>& stays, const TreeOfPoints& tree, Header& header) {
  header.level_count = prune(stays, tree);
  header.point_count = static_cast<std::uint32_t>(tree.points.size() / 3);
  header.node_count = static_cast<std::uint32_t>(tree.nodes.size());
}

}  // namespace godobject::scene_compiler
