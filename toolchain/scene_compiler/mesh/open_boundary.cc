#include "toolchain/scene_compiler/mesh/open_boundary.h"

#include <algorithm>
#include <cstdlib>

namespace godobject::scene_compiler {

using Eigen::Vector3d;

OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of) {
  struct Edge {
    std::uint32_t low, high;
    std::int32_t sense;
    bool same_ends(const Edge& other) const { return low == other.low && high == other.high; }
  };
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const SolidSurface::Component& component = components[component_of[i]];
    if (component.shell) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[i][k];
      const std::uint32_t to = mesh.triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), (from < to) != component.inside_out ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  OpenBoundary boundary;
  std::vector<TriangleTree::Triangle> open;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::int32_t balance = 0;
    std::size_t end = begin;
    while (end < edges.size() && edges[end].same_ends(edges[begin])) balance += edges[end++].sense;
    if (balance != 0) {
      const Vector3d& a = mesh.vertices[edges[begin].low];
      const Vector3d& b = mesh.vertices[edges[begin].high];
      open.push_back({a, b, b, static_cast<std::uint32_t>(open.size())});
      boundary.length += std::abs(balance) * (b - a).norm();
    }
    begin = end;
  }
  boundary.edges = TriangleTree(std::move(open));
  return boundary;
}

}  // namespace godobject::scene_compiler
