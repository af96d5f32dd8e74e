#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::viewer {

/// A closed box around the origin, corners at plus and minus `half` [m].
inline scene_compiler::TriangleMesh box(const Eigen::Vector3d& half) {
  scene_compiler::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(half.cwiseProduct(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace godobject::viewer
