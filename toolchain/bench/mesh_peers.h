#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::bench {

/// A library that tests the two meshes themselves.
struct MeshPeer {
  std::string name;  ///< "FCL collide"
  /// Runs one query with the moving mesh at H_WM and returns the number of contacts, or the distance [m].
  std::function<double(const Pose& H_WM)> query;
};

/// A peer that this build lacks.
struct MissingPeer {
  std::string name;
  std::string cure;
};

struct MeshPeers {
  std::vector<MeshPeer> peers;
  std::vector<MissingPeer> missing;
};

/// Builds bounding volume hierarchies over both meshes, each in its own frame [m].
MeshPeers mesh_peers(const scene_compiler::TriangleMesh& still, const scene_compiler::TriangleMesh& moving);

}  // namespace godobject::bench
