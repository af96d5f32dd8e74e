#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/body_mesh.h"

namespace godobject::scene_compiler {

/// A convex sharp edge: its faces meet at more than the crease angle, or it is the rim of a sheet. On a thickened sheet
/// every crease is convex from one side. Edges of more than two triangles do not count.
struct SharpEdge {
  std::uint32_t low, high;     ///< vertices
  Eigen::Vector3d outward;     ///< unit, across the edge, halfway between its faces
  Eigen::Vector3d normals[2];  ///< outward unit normals of its faces; 0 in a shell
  bool in_shell;
};

/// A convex sharp vertex: more than two sharp edges meet there, or two that turn by more than the crease angle, or it
/// is the apex of a cone without sharp edges.
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

/// Returns the unit vector in the plane of triangle `side`, across `edge`, away from the triangle; zero if the triangle
/// has no area.
Eigen::Vector3d away_from_triangle(const TriangleMesh& mesh, const MeshEdges::Edge& edge, const MeshEdges::Side& side);

}  // namespace godobject::scene_compiler
