#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Welded triangles in metres. Triangle corners index `vertices`, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace godobject::scene_compiler
