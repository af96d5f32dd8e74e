#include "toolchain/scene_compiler/mesh/near_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kRoundedReach = 1.0 + 1e-9;
constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

double squared_distance_to(const Vector3d& p, const TriangleTree::Triangle& t) {
  return (nearest_point_on_triangle(p, t.a, t.b, t.c) - p).squaredNorm();
}

}  // namespace

NearTriangles::NearTriangles(const TriangleTree& tree, const Vector3d& center, double radius) : center_(center) {
  TriangleTree::Nearest nearest{};
  if (!tree.nearest(center, kAnyDistance, nearest)) return;
  const double furthest = (std::sqrt(nearest.squared_distance) + 2.0 * radius) * kRoundedReach;
  tree.within(center, furthest, [&](const TriangleTree::Triangle& triangle) {
    near_.push_back({std::sqrt(squared_distance_to(center, triangle)), &triangle});
  });
  finish(radius);
}

NearTriangles::NearTriangles(const NearTriangles& larger, const Vector3d& center, double radius) : center_(center) {
  near_.reserve(larger.near_.size());
  for (const Near& near : larger.near_) {
    near_.push_back({std::sqrt(squared_distance_to(center, *near.triangle)), near.triangle});
  }
  finish(radius);
}

void NearTriangles::finish(double radius) {
  double least = kAnyDistance;
  for (const Near& near : near_) least = std::min(least, near.distance);
  const double furthest = (least + 2.0 * radius) * kRoundedReach;
  std::erase_if(near_, [&](const Near& near) { return near.distance > furthest; });
  std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
}

std::vector<std::uint32_t> NearTriangles::ids() const {
  std::vector<std::uint32_t> ids;
  for (const Near& near : near_) ids.push_back(near.triangle->id);
  return ids;
}

double NearTriangles::distance(const Vector3d& p) const {
  const double aside = (p - center_).norm();
  double best = kAnyDistance;
  double furthest = kAnyDistance;  // from the centre, of a triangle that may be nearer
  for (const Near& near : near_) {
    if (near.distance > furthest) break;
    const double squared = squared_distance_to(p, *near.triangle);
    if (squared >= best) continue;
    best = squared;
    furthest = (std::sqrt(best) + aside) * kRoundedReach;
  }
  return std::sqrt(best);
}

}  // namespace godobject::scene_compiler
