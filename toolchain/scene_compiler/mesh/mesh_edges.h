#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// The edges of a mesh, each with its triangles. Edges ascend by their vertices (low < high).
class MeshEdges {
 public:
  /// A triangle at an edge. `forward`: its counter-clockwise boundary runs from the edge's low vertex to its high one.
  struct Side {
    std::uint32_t triangle;
    std::uint32_t opposite;  ///< the vertex off the edge
    bool forward;
  };
  struct Edge {
    std::uint32_t low, high;
    std::uint32_t first_side, side_count;
  };

  explicit MeshEdges(const TriangleMesh& mesh);

  const std::vector<Edge>& all() const { return edges_; }
  std::span<const Side> sides(const Edge& edge) const { return {sides_.data() + edge.first_side, edge.side_count}; }

  /// True if every edge has two triangles that run along it in opposite directions.
  bool closed() const;

 private:
  std::vector<Edge> edges_;
  std::vector<Side> sides_;
};

}  // namespace godobject::scene_compiler
