#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// The points of a scene image: x[n], y[n], z[n] in tree order, their normals likewise (or none), and their sphere
/// tree.
struct TreeOfPoints {
  std::vector<float>& points;
  std::vector<float>& normals;
  std::vector<format::Node>& nodes;
};

/// As leave_out_points. Returns the number of levels, the points' own included.
std::uint32_t prune(const std::vector<bool>& stays, const TreeOfPoints& tree);

/// Leaves out points with stays[i] false; at least one must stay. The others keep their order and their bits, so sums
/// over them do too. Nodes without points disappear, and a node with a single child is replaced by it: there are fewer
/// than twice as many nodes as points. Spheres shrink to their contents. Updates the counts in `header`, a Body or
/// Features.
template <class Header>
void leave_out_points(const std::vector<bool>& stays, const TreeOfPoints& tree, Header& header) {
  header.level_count = prune(stays, tree);
  header.point_count = static_cast<std::uint32_t>(tree.points.size() / 3);
  header.node_count = static_cast<std::uint32_t>(tree.nodes.size());
}

}  // namespace godobject::scene_compiler
