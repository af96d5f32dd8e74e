#include "toolchain/scene_compiler/mesh/open_boundary.h"

#include <cstdlib>
#include <utility>

#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::scene_compiler {

using Eigen::Vector3d;

OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of) {
  const MeshEdges edges(mesh);
  OpenBoundary boundary;
  std::vector<TriangleTree::Triangle> open;
  for (const MeshEdges::Edge& edge : edges.all()) {
    std::int32_t balance = 0;
    for (const MeshEdges::Side& side : edges.sides(edge)) {
      const SolidSurface::Component& component = components[component_of[side.triangle]];
      if (!component.shell) balance += side.forward != component.inside_out ? 1 : -1;
    }
    if (balance == 0) continue;
    const Vector3d& a = mesh.vertices[edge.low];
    const Vector3d& b = mesh.vertices[edge.high];
    open.push_back({a, b, b, static_cast<std::uint32_t>(open.size())});
    boundary.length += std::abs(balance) * (b - a).norm();
  }
  boundary.edges = TriangleTree(std::move(open));
  return boundary;
}

}  // namespace godobject::scene_compiler
