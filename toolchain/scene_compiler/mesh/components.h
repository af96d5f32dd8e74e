#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Sets of triangles that are connected by shared vertices. A set's number follows the order of the sets' first
/// triangles.
struct Components {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> of_triangle;
};

Components connected_components(const TriangleMesh& mesh);

}  // namespace godobject::scene_compiler
