#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/body_mesh.h"

namespace godobject::scene_compiler {

/// An edge that sticks out: faces that meet convexly at more than the crease angle, or the rim of a sheet. Of a
/// thickened sheet every crease is convex from one side. Edges of more than two triangles are left out.
struct SharpEdge {
  std::uint32_t low, high;  ///< vertices
  Eigen::Vector3d outward;  ///< unit, across the edge, halfway between its faces
  bool in_shell;
};

/// A vertex that sticks out: where sharp edges meet (more than two, or two that turn by more than the crease angle), or
/// the apex of a cone without sharp edges.
struct SharpVertex {
  std::uint32_t vertex;
  Eigen::Vector3d outward;  ///< unit
  bool in_shell;
};

struct SharpFeatures {
  std::vector<SharpEdge> edges;
  std::vector<SharpVertex> vertices;
};

SharpFeatures sharp_features(const BodyMesh& body);

/// The unit vector in the plane of triangle `side`, across `edge`, away from the triangle; zero if it has no area.
Eigen::Vector3d away_from_triangle(const TriangleMesh& mesh, const MeshEdges::Edge& edge, const MeshEdges::Side& side);

}  // namespace godobject::scene_compiler
