#include "toolchain/watch/edge_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace godobject::watch {
namespace {

Vector3 nearest_on(const WatchedEdge& edge, const Vector3& p) {
  const Vector3 along = edge.end[1] - edge.end[0];
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return edge.end[0];
  return edge.end[0] + std::clamp((p - edge.end[0]).dot(along) / square, 0.0, 1.0) * along;
}

bool is_below_both_faces(const WatchedEdge& edge, const Vector3& direction) {
  return std::max(edge.normal[0].dot(direction), edge.normal[1].dot(direction)) < 0.0;
}

/// Tells whether the direction from an edge to its nearest point leads off at an end of the edge.
bool leads_off_an_end(const WatchedEdge& edge, const Vector3& direction) {
  return std::fabs((edge.end[1] - edge.end[0]).stableNormalized().dot(direction)) > 1e-3;
}

/// Tells whether an edge other than `but` is nearer than `distance` to a point.
bool has_nearer(const std::vector<WatchedEdge>& edges, std::size_t but, const Vector3& p, double distance) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k != but && (nearest_on(edges[k], p) - p).norm() < distance) return true;
  }
  return false;
}

/// Tells whether a direction leads over a face of the edge: it makes an acute angle with the tangent of that face that
/// points away from the edge.
bool leads_over_a_face(const WatchedEdge& edge, const Vector3& direction) {
  const Vector3 along = (edge.end[1] - edge.end[0]).stableNormalized();
  for (int k = 0; k < 2; ++k) {
    Vector3 tangent = along.cross(edge.normal[k]);
    if (tangent.dot(edge.normal[1 - k]) > 0.0) tangent = -tangent;
    if (tangent.dot(direction) > 1e-3) return true;
  }
  return false;
}

WatchedEdge between(const WatchedEdge& a, const WatchedEdge& b, double t) {
  WatchedEdge edge = a;
  for (int k = 0; k < 2; ++k) edge.end[k] = (1.0 - t) * a.end[k] + t * b.end[k];
  return edge;
}

}  // namespace

WatchedEdge WatchedEdge::at(const Pose& H) const {
  WatchedEdge edge = *this;
  for (int k = 0; k < 2; ++k) {
    edge.end[k] = H * end[k];
    edge.normal[k] = H.rotation._transformVector(normal[k]);
  }
  return edge;
}

std::vector<WatchedEdge> watched_edges(const SharpEdges& sharp) {
  std::vector<WatchedEdge> edges;
  for (const format::SharpEdge& edge : sharp.edges) {
    edges.push_back({{edge_end(edge, 0), edge_end(edge, 1)},
                     {face_normal(edge, 0), face_normal(edge, 1)},
                     static_cast<double>(edge.radius)});
  }
  return edges;
}

EdgeDistance distance_of(const WatchedEdge& first, const WatchedEdge& second) {
  EdgeDistance best;
  double least = std::numeric_limits<double>::infinity();
  const auto try_pair = [&](const Vector3& p, const Vector3& q) {
    const double distance = (p - q).norm();
    if (!(distance < least)) return;
    least = distance;
    best.on_first = p;
    best.on_second = q;
  };
  for (int k = 0; k < 2; ++k) {
    try_pair(first.end[k], nearest_on(second, first.end[k]));
    try_pair(nearest_on(first, second.end[k]), second.end[k]);
  }
  // both places of the common perpendicular, if they lie on the edges
  const Vector3 along_first = first.end[1] - first.end[0];
  const Vector3 along_second = second.end[1] - second.end[0];
  const Vector3 between = second.end[0] - first.end[0];
  const double both = along_first.dot(along_second);
  const double determinant = along_first.squaredNorm() * along_second.squaredNorm() - both * both;
  const double on_first = (along_second.squaredNorm() * along_first.dot(between) - both * along_second.dot(between));
  const double on_second = (both * along_first.dot(between) - along_first.squaredNorm() * along_second.dot(between));
  const auto is_on_edge = [&](double place) { return place >= 0.0 && place <= determinant; };
  if (determinant > 0.0 && is_on_edge(on_first) && is_on_edge(on_second)) {
    try_pair(first.end[0] + on_first / determinant * along_first,
             second.end[0] + on_second / determinant * along_second);
  }
  const Vector3 apart = best.on_first - best.on_second;
  best.normal = least > 1e-12 ? Vector3(apart / least) : along_first.cross(along_second).stableNormalized();
  best.gap = least - first.radius - second.radius;
  best.over_a_face = leads_over_a_face(second, best.normal) || leads_over_a_face(first, -best.normal);
  best.end_of_first = leads_off_an_end(first, best.normal);
  best.end_of_second = leads_off_an_end(second, best.normal);
  best.first_inside = !best.end_of_second && is_below_both_faces(second, best.normal);
  best.second_inside = !best.end_of_first && is_below_both_faces(first, -best.normal);
  return best;
}

Sides sides_of(const std::vector<WatchedEdge>& moving, const Pose& H_WS, const std::vector<WatchedEdge>& still,
               std::size_t i, std::size_t j, const EdgeDistance& distance) {
  if (distance.in_both_wedges()) return Sides::kOverlap;
  const double length = distance.length();
  if (distance.first_inside && distance.end_of_first) {
    return has_nearer(still, j, distance.on_first, length) ? Sides::kApart : Sides::kOverlap;
  }
  if (distance.second_inside && distance.end_of_second) {
    const Vector3 end_S = H_WS.inverse() * distance.on_second;
    return has_nearer(moving, i, end_S, length) ? Sides::kApart : Sides::kOverlap;
  }
  return distance.in_a_wedge() ? Sides::kAtAFace : Sides::kApart;
}

bool falls_below(const WatchedEdge& from, const WatchedEdge& to, const WatchedEdge& other, double limit,
                 double resolution) {
  const double begin = distance_of(from, other).gap - limit;
  const double end = distance_of(to, other).gap - limit;
  if (begin < 0.0 || end < 0.0) return true;
  const double length = std::max((to.end[0] - from.end[0]).norm(), (to.end[1] - from.end[1]).norm());
  if (begin + end > (1.0 + 1e-9) * length) return false;  // if equal, the edges may meet where the balls touch
  if (length < resolution) return std::min(begin, end) < 0.5 * length;
  const WatchedEdge middle = between(from, to, 0.5);
  return falls_below(from, middle, other, limit, resolution) || falls_below(middle, to, other, limit, resolution);
}

}  // namespace godobject::watch
