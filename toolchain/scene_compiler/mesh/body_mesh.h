#pragma once

#include <vector>

#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// The triangles of a body with what belongs to each. Those of solid components run counter-clockwise seen from
/// outside, also where the file has them inside out.
struct BodyMesh {
  explicit BodyMesh(const SolidSurface& surface);

  TriangleMesh mesh;
  MeshEdges edges;
  std::vector<Eigen::Vector3d> face_normals;  ///< unit; zero for a triangle without area
  std::vector<bool> in_shell;                 ///< by triangle: of a thickened sheet, both of whose sides are outside
  double half_thickness;                      ///< of shells [m]
  double diagonal;                            ///< of the bounding box [m]

  /// Closed and without shells.
  bool encloses_volume() const;
};

}  // namespace godobject::scene_compiler
