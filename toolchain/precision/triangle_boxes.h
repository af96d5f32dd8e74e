#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::precision {

using Corners = std::array<Eigen::Vector3d, 3>;  ///< of a triangle

/// True if the triangles have a point in common. Triangles that only touch may count either way.
bool intersect(const Corners& one, const Corners& other) noexcept;

/// The triangles of a mesh in a tree of boxes.
class TriangleBoxes {
 public:
  struct Node {
    Eigen::Vector3d low, high;
    std::uint32_t first, count;  ///< its triangles
    std::uint32_t right;         ///< second child; the first is the next node. 0 for a leaf, which has one triangle
  };

  explicit TriangleBoxes(const scene_compiler::TriangleMesh& mesh);

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }  ///< 0 is the root
  const Corners& triangle(std::uint32_t place) const { return triangles_[place]; }

  /// True if any triangle intersects `other`.
  bool any_intersects(const Corners& other) const;

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace godobject::precision
