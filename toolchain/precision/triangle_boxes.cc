#include "toolchain/precision/triangle_boxes.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

namespace godobject::precision {
namespace {

using Eigen::Vector3d;

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) noexcept {
  return (b - a).cross(c - a).dot(d - a);
}

bool crosses(const Vector3d& from, const Vector3d& to, const Corners& t) noexcept {
  if (volume(t[0], t[1], t[2], from) * volume(t[0], t[1], t[2], to) > 0.0) return false;
  const double u = volume(from, to, t[0], t[1]);
  const double v = volume(from, to, t[1], t[2]);
  const double w = volume(from, to, t[2], t[0]);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

bool any_edge_crosses(const Corners& edges, const Corners& t) noexcept {
  return crosses(edges[0], edges[1], t) || crosses(edges[1], edges[2], t) || crosses(edges[2], edges[0], t);
}

Vector3d low_of(const Corners& t) { return t[0].cwiseMin(t[1]).cwiseMin(t[2]); }
Vector3d high_of(const Corners& t) { return t[0].cwiseMax(t[1]).cwiseMax(t[2]); }

}  // namespace

bool intersect(const Corners& one, const Corners& other) noexcept {
  return any_edge_crosses(one, other) || any_edge_crosses(other, one);
}

TriangleBoxes::TriangleBoxes(const scene_compiler::TriangleMesh& mesh) {
  for (const auto& t : mesh.triangles)
    triangles_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

/// Halves the triangles along the longest axis of the box, so the depth is the logarithm of their number.
std::uint32_t TriangleBoxes::build(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{low_of(triangles_[first]), high_of(triangles_[first]), first, count, 0};
  for (std::uint32_t i = first; i < first + count; ++i) {
    node.low = node.low.cwiseMin(low_of(triangles_[i]));
    node.high = node.high.cwiseMax(high_of(triangles_[i]));
  }
  nodes_.push_back(node);
  if (count == 1) return index;
  Eigen::Index axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [axis](const Corners& a, const Corners& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  build(first, half);
  nodes_[index].right = build(first + half, count - half);
  return index;
}

bool TriangleBoxes::any_intersects(const Corners& other) const {
  if (nodes_.empty()) return false;
  const Vector3d low = low_of(other);
  const Vector3d high = high_of(other);
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    const Node& node = nodes_[index];
    open.pop_back();
    if ((node.low.array() > high.array()).any() || (node.high.array() < low.array()).any()) continue;
    if (node.right == 0) {
      if (intersect(triangles_[node.first], other)) return true;
      continue;
    }
    open.push_back(node.right);
    open.push_back(index + 1);
  }
  return false;
}

}  // namespace godobject::precision
