#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::scene_compiler {

/// The edge between two faces is sharp if their normals differ by more than the crease angle, 30 degrees.
inline constexpr double kCreaseCosine = 0.86602540378443865;

/// Returns the unit normal of each face, from whose tip the winding is counter-clockwise; zero for a triangle without
/// area.
std::vector<Eigen::Vector3d> face_normals(const TriangleMesh& mesh);

/// Returns normals at each triangle's corners, for interpolation over the triangle. Each is the mean of the normals of
/// the faces at that vertex, weighted by their angles there. Only faces within the crease angle of the triangle's own
/// normal count.
std::vector<std::array<Eigen::Vector3d, 3>> corner_normals(const TriangleMesh& mesh,
                                                           const std::vector<Eigen::Vector3d>& face_normals);

/// Returns the angle of triangle `t` at its corner 0 .. 2 [rad].
double corner_angle(const TriangleMesh& mesh, std::size_t t, std::size_t corner);

/// The triangle corners at each vertex of a mesh.
class VertexCorners {
 public:
  explicit VertexCorners(const TriangleMesh& mesh);

  /// Returns the corners at a vertex as numbers 3 * triangle + corner.
  std::span<const std::size_t> of(std::uint32_t vertex) const {
    return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::size_t> corners_;
};

}  // namespace godobject::scene_compiler
