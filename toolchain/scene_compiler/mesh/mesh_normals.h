#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// Faces that meet at a larger angle than 30 degrees have a sharp edge between them.
inline constexpr double kCreaseCosine = 0.86602540378443865;

/// Unit normals, counter-clockwise winding seen from their tip; zero for a triangle without area.
std::vector<Eigen::Vector3d> face_normals(const TriangleMesh& mesh);

/// Normals at each triangle's corners, to be interpolated over it: the mean of the normals of the faces at that vertex,
/// weighted by their angle there, of those that are less than the crease angle off the triangle's own.
std::vector<std::array<Eigen::Vector3d, 3>> corner_normals(const TriangleMesh& mesh,
                                                           const std::vector<Eigen::Vector3d>& face_normals);

/// Angle of triangle `t` at its corner 0 .. 2 [rad].
double corner_angle(const TriangleMesh& mesh, std::size_t t, std::size_t corner);

/// The triangle corners at each vertex.
class VertexCorners {
 public:
  explicit VertexCorners(const TriangleMesh& mesh);

  /// As 3 * triangle + corner.
  std::span<const std::size_t> of(std::uint32_t vertex) const {
    return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::size_t> corners_;
};

}  // namespace godobject::scene_compiler
