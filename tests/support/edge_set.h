#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/scene/sharp_edges.h"
#include "godobject/pose.h"

namespace godobject::test {

/// Sharp edges of one body with a tree over them: halves of the list, so its spheres overlap if the list is in
/// disorder.
class EdgeSet {
 public:
  /// Edges of a sheet without thickness between pairs of points [m].
  explicit EdgeSet(const std::vector<std::pair<Vector3, Vector3>>& segments) {
    for (const auto& [from, to] : segments) {
      format::SharpEdge edge{};
      for (int axis = 0; axis < 3; ++axis) {
        edge.end[0][axis] = from[axis];
        edge.end[1][axis] = to[axis];
      }
      edges_.push_back(edge);
    }
    if (!edges_.empty()) add(0, static_cast<std::uint32_t>(edges_.size()), 0);
  }

  SharpEdges view() const { return {edges_, nodes_}; }
  std::vector<format::SharpEdge>& edges() { return edges_; }

 private:
  void add(std::uint32_t first, std::uint32_t count, std::uint16_t level) {
    const std::size_t at = nodes_.size();
    format::Node node{};
    Vector3 middle = Vector3::Zero();
    for (std::uint32_t i = first; i < first + count; ++i) middle += edge_end(edges_[i], 0) + edge_end(edges_[i], 1);
    middle /= 2.0 * count;
    for (int axis = 0; axis < 3; ++axis) node.center[axis] = static_cast<float>(middle[axis]);
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (int k = 0; k < 2; ++k) {
        node.radius = std::max(node.radius, static_cast<float>((edge_end(edges_[i], k) - middle).norm() * 1.00001));
      }
    }
    node.first_point = first;
    node.point_count = count;
    node.level = level;
    node.leaf = count <= 2 ? 1 : 0;
    nodes_.push_back(node);
    if (count > 2) {
      add(first, count / 2, static_cast<std::uint16_t>(level + 1));
      add(first + count / 2, count - count / 2, static_cast<std::uint16_t>(level + 1));
    }
    nodes_[at].skip = static_cast<std::uint32_t>(nodes_.size());
  }

  std::vector<format::SharpEdge> edges_;
  std::vector<format::Node> nodes_;
};

}  // namespace godobject::test
