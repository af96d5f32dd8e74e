#include "core/scene/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace godobject {
namespace {

using Vector3Map = Eigen::Map<const Vector3>;
using Vector3fMap = Eigen::Map<const Eigen::Vector3f>;

/// Nearer to an edge or a vertex than this the direction from it is lost in rounding [m]. Chosen: a thousandth of the
/// smallest voxel that an image may have.
constexpr double kOnEdge = 1e-12;

/// The nearest place found so far.
struct NearestPlace {
  double squared_distance = std::numeric_limits<double>::infinity();
  Vector3 from = Vector3::Zero();    ///< from the place to the point [m]
  Vector3 normal = Vector3::Zero();  ///< of the face, edge or vertex on which it lies
  bool on_face = false;
};

/// Compares the places of one edge, from `vertex` along `edge`. `from` leads from the vertex to the point.
void compare_edge(const format::Facet& facet, int k, const Vector3& from, const Vector3& edge,
                  NearestPlace& nearest) noexcept {
  const double along = from.dot(edge);
  const double squared_length = edge.squaredNorm();
  Vector3 away = from;
  const float* normal = facet.vertex_normal[k];
  if (along >= squared_length) {
    away -= edge;
    normal = facet.vertex_normal[k == 2 ? 0 : k + 1];
  } else if (along > 0.0) {
    away -= along / squared_length * edge;
    normal = facet.edge_normal[k];
  }
  const double squared = away.squaredNorm();
  if (squared >= nearest.squared_distance) return;
  nearest = {squared, away, Vector3fMap(normal).cast<double>(), false};
}

/// Compares the nearest place of a facet. The triangle lies on the inner side of its edges' planes. So p is at least as
/// far from it as from the intersection of its plane with the outer side of any of them: most facets end there.
void compare(const format::Facet& facet, const Vector3& p, NearestPlace& nearest) noexcept {
  const Eigen::Map<const Eigen::Matrix4d> plane(facet.plane[0]);
  const Eigen::Vector4d height = plane.col(0) * p.x() + plane.col(1) * p.y() + plane.col(2) * p.z() + plane.col(3);
  const double squared = height[0] * height[0];
  const double outside = std::max(std::max(height[1], height[2]), height[3]);
  const double least = outside > 0.0 ? squared + outside * outside : squared;
  if (least >= nearest.squared_distance) return;
  if (outside <= 0.0) {
    const Vector3 normal = face_normal(facet);
    nearest = {squared, height[0] * normal, normal, true};
    return;
  }
  for (int k = 0; k < 3; ++k) {
    if (height[k + 1] <= 0.0) continue;
    const Vector3 vertex = Vector3Map(facet.vertex[k]);
    compare_edge(facet, k, p - vertex, Vector3Map(facet.vertex[k == 2 ? 0 : k + 1]) - vertex, nearest);
  }
}

ValueAndGradient signed_distance(const NearestPlace& nearest) noexcept {
  const double distance = std::sqrt(nearest.squared_distance);
  const double side = nearest.from.dot(nearest.normal) >= 0.0 ? 1.0 : -1.0;
  if (nearest.on_face) return {side * distance, nearest.normal};
  if (distance < kOnEdge) return {side * distance, nearest.normal.normalized()};
  return {side * distance, side / distance * nearest.from};
}

}  // namespace

void set_planes(format::Facet& facet, const Vector3& normal) noexcept {
  Eigen::Map<Eigen::Matrix4d> plane(facet.plane[0]);
  for (int i = 0; i < 4; ++i) {
    const Vector3Map vertex(facet.vertex[i == 0 ? 0 : i - 1]);
    const Vector3 out =
        i == 0 ? normal : Vector3((Vector3Map(facet.vertex[i % 3]) - vertex).cross(normal).normalized());
    plane.row(i) << out.transpose(), -out.dot(vertex);
  }
}

ValueAndGradient facet_distance(std::span<const format::Facet> facets, std::span<const std::uint32_t> numbers,
                                const Vector3& p) noexcept {
  NearestPlace nearest;
  for (const std::uint32_t number : numbers) compare(facets[number], p, nearest);
  return signed_distance(nearest);
}

ValueAndGradient facet_distance(const FacetLists& lists, std::uint32_t set, const Vector3& p) noexcept {
  double least = std::numeric_limits<double>::infinity();
  const format::Facet* nearest = nullptr;
  for (const std::uint32_t number : lists.planes_of(set)) {
    const double(&plane)[4][4] = lists.facets[number].plane;
    const double height = plane[0][0] * p.x() + plane[1][0] * p.y() + plane[2][0] * p.z() + plane[3][0];
    if (height >= least) continue;
    least = height;
    nearest = &lists.facets[number];
  }
  if (nearest != nullptr && least >= 0.0) return {least, face_normal(*nearest)};
  return facet_distance(lists.facets, lists.of(set), p);
}

}  // namespace godobject
