#include "toolchain/scene_compiler/mesh/open_boundary.h"

#include <cstdlib>
#include <utility>

#include "toolchain/scene_compiler/mesh/components.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {

using Eigen::Vector3d;

namespace {

// Chosen; of the number and of the area of the solids' triangles. A mesh with a few holes is far below both.
constexpr double kMostCaps = 0.125;
constexpr double kMostCapArea = 0.5;

/// An edge with its balance: how many more triangles run from a to b than back.
struct OpenEdge {
  std::uint32_t a, b;
  std::int32_t balance;
};

std::vector<TriangleTree::Triangle> caps_of(const TriangleMesh& mesh, const std::vector<OpenEdge>& open) {
  if (open.empty()) return {};
  TriangleMesh edges{mesh.vertices, {}};
  for (const OpenEdge& edge : open) edges.triangles.push_back({edge.a, edge.b, edge.b});
  const Components sets = connected_components(edges);
  std::vector<Vector3d> middle(sets.count, Vector3d::Zero());
  std::vector<double> count(sets.count);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t set = sets.of_triangle[i];
    middle[set] += 0.5 * (mesh.vertices[open[i].a] + mesh.vertices[open[i].b]);
    count[set] += 1.0;
  }
  std::vector<TriangleTree::Triangle> caps;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t set = sets.of_triangle[i];
    const bool forward = open[i].balance > 0;  // a cap runs along its edge the other way
    const Vector3d& from = mesh.vertices[forward ? open[i].b : open[i].a];
    const Vector3d& to = mesh.vertices[forward ? open[i].a : open[i].b];
    for (std::int32_t k = 0; k < std::abs(open[i].balance); ++k) {
      caps.push_back({from, to, middle[set] / count[set], static_cast<std::uint32_t>(caps.size())});
    }
  }
  return caps;
}

bool are_small(const std::vector<TriangleTree::Triangle>& caps, std::size_t solid_triangles, double solid_area) {
  double area = 0.0;
  for (const TriangleTree::Triangle& cap : caps) area += triangle_area(cap.a, cap.b, cap.c);
  return static_cast<double>(caps.size()) <= kMostCaps * static_cast<double>(solid_triangles) &&
         area <= kMostCapArea * solid_area;
}

}  // namespace

OpenBoundary open_boundary(const TriangleMesh& mesh, const std::vector<SolidSurface::Component>& components,
                           const std::vector<std::uint32_t>& component_of) {
  const MeshEdges edges(mesh);
  OpenBoundary boundary;
  std::vector<TriangleTree::Triangle> triangles;
  std::vector<OpenEdge> open;
  for (const MeshEdges::Edge& edge : edges.all()) {
    std::int32_t balance = 0;
    for (const MeshEdges::Side& side : edges.sides(edge)) {
      const SolidSurface::Component& component = components[component_of[side.triangle]];
      if (!component.shell) balance += side.forward != component.inside_out ? 1 : -1;
    }
    if (balance == 0) continue;
    const Vector3d& a = mesh.vertices[edge.low];
    const Vector3d& b = mesh.vertices[edge.high];
    triangles.push_back({a, b, b, static_cast<std::uint32_t>(open.size())});
    open.push_back({edge.low, edge.high, balance});
    boundary.length += std::abs(balance) * (b - a).norm();
  }
  boundary.edges = TriangleTree(std::move(triangles));
  std::vector<TriangleTree::Triangle> caps = caps_of(mesh, open);
  std::size_t solid_triangles = 0;
  double solid_area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (components[component_of[i]].shell) continue;
    const auto& t = mesh.triangles[i];
    ++solid_triangles;
    solid_area += triangle_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  }
  boundary.caps_are_small = are_small(caps, solid_triangles, solid_area);
  boundary.caps = TriangleTree(std::move(caps));
  return boundary;
}

}  // namespace godobject::scene_compiler
