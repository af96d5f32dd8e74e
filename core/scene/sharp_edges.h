#pragma once

#include <cstddef>
#include <span>

#include "core/scene/format.h"
#include "godobject/pose.h"

namespace godobject {

/// The convex sharp edges of one body with their sphere tree. A view; owns nothing.
struct SharpEdges {
  std::span<const format::SharpEdge> edges;
  std::span<const format::Node> nodes;  ///< pre-order; nodes[0] contains all edges

  bool empty() const noexcept { return edges.empty(); }
};

/// Returns end `k` of an edge, in its body's frame [m].
inline Vector3 edge_end(const format::SharpEdge& edge, int k) noexcept {
  return {edge.end[k][0], edge.end[k][1], edge.end[k][2]};
}

/// Returns the outward unit normal of face `k` of an edge, in its body's frame.
inline Vector3 face_normal(const format::SharpEdge& edge, int k) noexcept {
  return {static_cast<double>(edge.normal[k][0]), static_cast<double>(edge.normal[k][1]),
          static_cast<double>(edge.normal[k][2])};
}

}  // namespace godobject
