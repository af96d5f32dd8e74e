#pragma once

#include <vector>

#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// The triangles of a body with their edges, normals and kinds. The triangles of solid components run counter-clockwise
/// seen from outside, also if the file has them inside out.
struct BodyMesh {
  explicit BodyMesh(const SolidSurface& surface);

  TriangleMesh mesh;
  MeshEdges edges;
  std::vector<Eigen::Vector3d> face_normals;  ///< unit; zero for a triangle without area
  std::vector<bool> in_shell;  ///< by triangle: part of a thickened sheet, so both of its sides are outside
  double half_thickness;       ///< of shells [m]
  double diagonal;             ///< of the bounding box [m]

  /// True if the mesh is closed and has no shells.
  bool encloses_volume() const;
};

}  // namespace godobject::scene_compiler
