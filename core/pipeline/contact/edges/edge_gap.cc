#include "core/pipeline/contact/edges/edge_gap.h"

#include <algorithm>
#include <cmath>

namespace godobject {
namespace {

/// The places of the nearest points of two segments, as shares of their lengths.
struct Places {
  double on_first;
  double on_second;
};

/// Returns the nearest points of two segments. Alternates between the two if one of the places lies beyond an end: the
/// squared distance is convex, so the second projection is exact (Ericson, Real-Time Collision Detection, 5.1.9).
Places nearest_places(const Vector3& p, const Vector3& along_p, const Vector3& q, const Vector3& along_q) noexcept {
  const double pp = along_p.squaredNorm();
  const double qq = along_q.squaredNorm();
  const double pq = along_p.dot(along_q);
  const double determinant = pp * qq - pq * pq;
  const Vector3 from_q = p - q;
  double on_p = 0.0;
  if (determinant > 1e-12 * pp * qq) {
    on_p = std::clamp((pq * along_q.dot(from_q) - qq * along_p.dot(from_q)) / determinant, 0.0, 1.0);
  } else {
    on_p = nearest_place(p, along_p, pp, q + 0.5 * along_q);  // parallel: in the middle of the second if it can
  }
  const double on_q = nearest_place(q, along_q, qq, p + on_p * along_p);
  return {nearest_place(p, along_p, pp, q + on_q * along_q), on_q};
}

/// The nearest points of two edges.
struct Nearest {
  double place;       ///< of `on_moving` [1]
  Vector3 on_moving;  ///< [m]
  Vector3 on_still;   ///< [m]
};

Nearest nearest_points(const EdgeInW& moving, const EdgeInW& still) noexcept {
  const Vector3 along_moving = moving.end[1] - moving.end[0];
  const Vector3 along_still = still.end[1] - still.end[0];
  const Places places = nearest_places(moving.end[0], along_moving, still.end[0], along_still);
  return {places.on_first, moving.end[0] + places.on_first * along_moving,
          still.end[0] + places.on_second * along_still};
}

/// Tells whether both faces of an edge look away from the direction: it leads into the body.
bool leads_inside(const EdgeInW& edge, const Vector3& direction) noexcept {
  return edge.normal[0].dot(direction) < 0.0 && edge.normal[1].dot(direction) < 0.0;
}

/// Tells whether a unit vector is perpendicular to an edge, as at nearest points that are no ends.
bool is_across(const EdgeInW& edge, const Vector3& direction) noexcept {
  constexpr double kSlack = 1e-3;  // [rad] chosen: far above rounding
  const Vector3 along = edge.end[1] - edge.end[0];
  return std::fabs(along.dot(direction)) <= kSlack * along.norm();
}

/// Returns which nearest points lie inside the wedge of the other edge. Beyond an end of an edge its wedge ends.
EdgeInside inside(const EdgeInW& moving, const EdgeInW& still, const Vector3& normal) noexcept {
  const bool moving_has_end = !is_across(moving, normal);
  const bool still_has_end = !is_across(still, normal);
  const bool moving_point = !still_has_end && leads_inside(still, normal);
  const bool still_point = !moving_has_end && leads_inside(moving, -normal);
  if (moving_point && still_point) return EdgeInside::kBoth;
  if (moving_point) return moving_has_end ? EdgeInside::kEndOfMoving : EdgeInside::kPoint;
  if (still_point) return still_has_end ? EdgeInside::kEndOfStill : EdgeInside::kPoint;
  return EdgeInside::kNone;
}

/// Tells whether a direction from an edge leads over one of its faces: it has a part away from the edge in the plane of
/// the face.
bool leads_over_a_face(const EdgeInW& edge, const Vector3& direction) noexcept {
  constexpr double kSlack = 1e-3;  // [rad] chosen: an edge that touches along a face counts
  for (int k = 0; k < 2; ++k) {
    const Vector3& normal = edge.normal[k];
    const Vector3& other = edge.normal[1 - k];
    const Vector3 along_face = normal.dot(other) * normal - other;  // away from the edge, since the edge is convex
    if (along_face.dot(direction) > kSlack * along_face.norm()) return true;
  }
  return false;
}

}  // namespace

double edge_distance(const EdgeInW& moving, const EdgeInW& still) noexcept {
  const Nearest nearest = nearest_points(moving, still);
  return (nearest.on_moving - nearest.on_still).norm() - (moving.radius + still.radius);
}

EdgeGap edge_gap(const EdgeInW& moving, const EdgeInW& still, double deepest) noexcept {
  constexpr double kMeet = 1e-12;  // [m] derived: the difference of coordinates of a metre has no direction below
  const Nearest nearest = nearest_points(moving, still);
  EdgeGap gap;
  gap.place = nearest.place;
  gap.on_moving = nearest.on_moving;
  gap.on_still = nearest.on_still;
  const Vector3 between = gap.on_moving - gap.on_still;
  const double length = between.norm();
  const Vector3 out_of_still = still.normal[0] + still.normal[1] - moving.normal[0] - moving.normal[1];
  if (length > kMeet) {
    gap.normal = between / length;
  } else {
    const Vector3 across = (moving.end[1] - moving.end[0]).cross(still.end[1] - still.end[0]).stableNormalized();
    if (across.isZero(0.0)) {
      gap.normal = out_of_still.stableNormalized();
    } else {
      gap.normal = across.dot(out_of_still) < 0.0 ? Vector3(-across) : across;
    }
  }
  gap.distance = length - (moving.radius + still.radius);
  if (length > kMeet && length < deepest) {
    gap.inside = inside(moving, still, gap.normal);
    if (gap.inside == EdgeInside::kBoth) {
      gap.turn_round();
      return gap;
    }
  }
  gap.is_nearest = !leads_over_a_face(still, gap.normal) && !leads_over_a_face(moving, -gap.normal);
  return gap;
}

}  // namespace godobject
