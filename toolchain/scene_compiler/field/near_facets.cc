#include "toolchain/scene_compiler/field/near_facets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kRoundedReach = 1.0 + 1e-9;

/// Returns a lower bound of the squared distance [m^2]: the triangle lies in its plane, on the inner side of the planes
/// of its edges. It is zero for a facet without a normal, whose planes are zero.
double least_squared_distance(const format::Facet& facet, const Vector3d& p) {
  const Eigen::Map<const Eigen::Matrix4d> plane(facet.plane[0]);
  const Eigen::Vector4d height = plane.col(0) * p.x() + plane.col(1) * p.y() + plane.col(2) * p.z() + plane.col(3);
  const double outside = std::max({0.0, height[1], height[2], height[3]});
  return height[0] * height[0] + outside * outside;
}

double squared_distance(const format::Facet& facet, const Vector3d& p) {
  using Vertex = Eigen::Map<const Vector3d>;
  const Vector3d on =
      nearest_point_on_triangle(p, Vertex(facet.vertex[0]), Vertex(facet.vertex[1]), Vertex(facet.vertex[2]));
  return (on - p).squaredNorm();
}

}  // namespace

double squared_distance_within(const format::Facet& facet, const Vector3d& p, double most) {
  const double least = least_squared_distance(facet, p);
  return least > most ? least : squared_distance(facet, p);
}

void NearFacets::find(std::span<const std::uint32_t> numbers, const Vector3d& center, double radius,
                      std::vector<std::uint32_t>& near) {
  least_.resize(numbers.size());
  squared_.assign(numbers.size(), -1.0);
  for (std::size_t i = 0; i < numbers.size(); ++i) least_[i] = least_squared_distance(facets_[numbers[i]], center);
  const auto squared = [&](std::size_t i) {
    if (squared_[i] < 0.0) squared_[i] = squared_distance(facets_[numbers[i]], center);
    return squared_[i];
  };
  auto nearest = static_cast<std::size_t>(std::min_element(least_.begin(), least_.end()) - least_.begin());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (least_[i] < squared(nearest) && squared(i) < squared(nearest)) nearest = i;
  }
  const double furthest = (std::sqrt(squared(nearest)) + 2.0 * radius) * kRoundedReach;
  near.clear();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (least_[i] <= furthest * furthest && squared(i) <= furthest * furthest) near.push_back(numbers[i]);
  }
}

}  // namespace godobject::scene_compiler
