#include "toolchain/scene_compiler/mesh/mesh_normals.h"

#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {

using Eigen::Vector3d;

std::vector<Vector3d> face_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    normals.push_back((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).stableNormalized());
  }
  return normals;
}

double corner_angle(const TriangleMesh& mesh, std::size_t t, std::size_t corner) {
  const auto& corners = mesh.triangles[t];
  const Vector3d& at = mesh.vertices[corners[corner]];
  const Vector3d a = mesh.vertices[corners[(corner + 1) % 3]] - at;
  const Vector3d b = mesh.vertices[corners[(corner + 2) % 3]] - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

VertexCorners::VertexCorners(const TriangleMesh& mesh)
    : first_(mesh.vertices.size() + 1, 0), corners_(3 * mesh.triangles.size()) {
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t c = 0; c < corners_.size(); ++c) corners_[next[mesh.triangles[c / 3][c % 3]]++] = c;
}

std::vector<std::array<Vector3d, 3>> corner_normals(const TriangleMesh& mesh,
                                                    const std::vector<Vector3d>& face_normals) {
  const VertexCorners around(mesh);
  std::vector<std::array<Vector3d, 3>> normals(mesh.triangles.size());
  parallel::for_each_index(mesh.triangles.size(), [&](std::size_t t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vector3d sum = Vector3d::Zero();
      for (const std::size_t other : around.of(mesh.triangles[t][corner])) {
        const Vector3d& normal = face_normals[other / 3];
        if (normal.dot(face_normals[t]) > kCreaseCosine) sum += corner_angle(mesh, other / 3, other % 3) * normal;
      }
      normals[t][corner] = sum.stableNormalized();
    }
  });
  return normals;
}

}  // namespace godobject::scene_compiler
