#include "toolchain/scene_compiler/mesh/polygon.h"

#include <Eigen/Geometry>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// Returns twice the signed area of a, b, c, projected along `normal`.
double turn(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal) {
  return (b - a).cross(c - a).dot(normal);
}

}  // namespace

void triangulate(const std::vector<Vector3d>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> left(corners.begin(), corners.end());
  Vector3d normal = Vector3d::Zero();  // Newell's normal: correct for concave polygons too
  for (std::size_t i = 1; i + 1 < left.size(); ++i) {
    normal += (vertices[left[i]] - vertices[left[0]]).cross(vertices[left[i + 1]] - vertices[left[0]]);
  }
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = left.size();
    const std::uint32_t before = left[(i + n - 1) % n];
    const std::uint32_t after = left[(i + 1) % n];
    const Vector3d& a = vertices[before];
    const Vector3d& b = vertices[left[i]];
    const Vector3d& c = vertices[after];
    if (turn(a, b, c, normal) <= 0.0) return false;
    for (const std::uint32_t other : left) {
      if (other == before || other == left[i] || other == after) continue;
      const Vector3d& p = vertices[other];
      if (turn(a, b, p, normal) >= 0.0 && turn(b, c, p, normal) >= 0.0 && turn(c, a, p, normal) >= 0.0) return false;
    }
    return true;
  };
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(ear)) ++ear;
    if (ear == left.size()) ear = 0;  // the polygon crosses itself or has no area: any cut is as good
    const std::size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
}

}  // namespace godobject::scene_compiler
