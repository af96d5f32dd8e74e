#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Cuts a simple polygon, (nearly) flat, convex or not, into corners.size() - 2 triangles of the same sense by ear
/// clipping. `corners` index `vertices`. Appends the triangles.
void triangulate(const std::vector<Eigen::Vector3d>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace godobject::scene_compiler
