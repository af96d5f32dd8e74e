#include "core/pipeline/contact/implied_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace godobject::detail {
namespace {

/// An edge pair seen from the body of a point.
struct SeenPair {
  EdgeInW own;           ///< edge of the point's body
  EdgeInW other;         ///< edge of the other body
  std::uint32_t number;  ///< of the other edge
  Vector3 on_other;      ///< nearest point of the other edge [m]
};

/// Returns the share of an edge, from end 0 to end 1, at which it is nearest to a point.
double place_of(const EdgeInW& edge, const Vector3& p) noexcept {
  const Vector3 along = edge.end[1] - edge.end[0];
  return std::clamp(along.dot(p - edge.end[0]) / along.squaredNorm(), 0.0, 1.0);
}

double distance_to(const EdgeInW& edge, const Vector3& p) noexcept {
  return (p - edge.end[0] - place_of(edge, p) * (edge.end[1] - edge.end[0])).norm();
}

/// Tells whether a face beside both edges contains the point.
bool share_a_face(const EdgeInW& first, const EdgeInW& second, const Vector3& p, double tolerance) noexcept {
  constexpr double kSameFace = 1.0 - 1e-9;  // cosine; derived: unit normals in single precision
  for (const Vector3& normal : first.normal) {
    const bool is_face_of_second = std::max(normal.dot(second.normal[0]), normal.dot(second.normal[1])) > kSameFace &&
                                   std::fabs(normal.dot(second.end[0] - first.end[0])) <= tolerance;
    if (is_face_of_second && std::fabs(normal.dot(p - first.end[0])) <= tolerance) return true;
  }
  return false;
}

}  // namespace

bool is_implied(const HeldPoint& point, const EdgeContacts& edges, const NearEdges& near, const Pose& H_WS,
                const ContactRows& rows, double margin, double tolerance) noexcept {
  const Vector3& p = point.position_W;
  const auto counts = [&](std::uint32_t k) noexcept {
    return near.gap[k].is_nearest && near.gap[k].distance <= point.distance + margin &&
           rows.find(id_of(near.pair[k]), 0) < rows.count;
  };
  const auto seen = [&](std::uint32_t k) noexcept {
    const EdgePair& pair = near.pair[k];
    SeenPair result{EdgeInW::at(edges.moving.edges[pair.moving], H_WS),
                    EdgeInW::of_still(edges.still.edges[pair.still]), pair.still, near.gap[k].on_still};
    if (!point.is_feature) return result;
    std::swap(result.own, result.other);
    result.number = pair.moving;
    result.on_other = near.gap[k].on_moving;
    return result;
  };
  for (std::uint32_t k = 0; k < near.count; ++k) {
    if (!counts(k)) continue;
    const SeenPair first = seen(k);
    const double apart = distance_to(first.other, p) - (first.own.radius + first.other.radius);
    if (std::fabs(apart - point.distance) > tolerance) continue;
    if (distance_to(first.own, p) <= tolerance) return true;
    const double place = place_of(first.other, p);
    const double begin = place_of(first.other, first.on_other);
    for (std::uint32_t l = k + 1; l < near.count; ++l) {
      if (!counts(l)) continue;
      const SeenPair second = seen(l);
      if (second.number != first.number) continue;
      const double end = place_of(first.other, second.on_other);
      const bool is_between = std::min(begin, end) <= place && place <= std::max(begin, end);
      if (is_between && share_a_face(first.own, second.own, p, tolerance)) return true;
    }
  }
  return false;
}

}  // namespace godobject::detail
