#include "core/pipeline/contact/implied_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace godobject::detail {
namespace {

/// An edge pair seen from the body of a point.
struct SeenPair {
  EdgeInW own;            ///< edge of the point's body
  EdgeInW other;          ///< edge of the other body
  std::uint32_t number;   ///< of the other edge
  Vector3 on_own;         ///< nearest point of the own edge [m]
  double place_on_other;  ///< of the nearest points, on the other edge [1]
  double gap;             ///< [m]
};

/// Returns the share of an edge, from end 0 to end 1, at which it is nearest to a point.
double place_of(const EdgeInW& edge, const Vector3& p) noexcept {
  const Vector3 along = edge.end[1] - edge.end[0];
  return nearest_place(edge.end[0], along, along.squaredNorm(), p);
}

double distance_to(const EdgeInW& edge, const Vector3& p) noexcept {
  return (p - edge.end[0] - place_of(edge, p) * (edge.end[1] - edge.end[0])).norm();
}

/// Tells whether two edges are clearly not parallel.
bool cross(const EdgeInW& a, const EdgeInW& b) noexcept {
  constexpr double kLeastSine = 0.05;  // of the angle, chosen
  const Vector3 along_a = a.end[1] - a.end[0];
  const Vector3 along_b = b.end[1] - b.end[0];
  return along_a.cross(along_b).squaredNorm() > kLeastSine * kLeastSine * along_a.squaredNorm() * along_b.squaredNorm();
}

/// Tells whether a face beside both edges contains the point.
bool share_a_face(const EdgeInW& first, const EdgeInW& second, const Vector3& p, double tolerance) noexcept {
  constexpr double kSameNormal = 1e-6;  // derived: unit normals are stored in single precision
  for (const Vector3& a : first.normal) {
    if (a.isZero(0.0)) continue;
    for (const Vector3& b : second.normal) {
      if ((a - b).squaredNorm() <= kSameNormal * kSameNormal &&
          std::fabs(a.dot(second.end[0] - first.end[0])) <= tolerance &&
          std::fabs(a.dot(p - first.end[0])) <= tolerance) {
        return true;
      }
    }
  }
  return false;
}

SeenPair seen_from(const HeldPoint& point, const EdgeContacts& edges, const NearEdges& near, std::uint32_t k,
                   const Pose& H_WS) noexcept {
  const EdgePair& pair = near.pair[k];
  const EdgeGap& gap = near.gap[k];
  const EdgeInW moving = EdgeInW::at(edges.moving.edges[pair.moving], H_WS);
  const EdgeInW still = EdgeInW::of_still(edges.still.edges[pair.still]);
  if (point.is_feature)
    return {still, moving, pair.moving, gap.on_still, place_of(moving, gap.on_moving), gap.distance};
  return {moving, still, pair.still, gap.on_moving, place_of(still, gap.on_still), gap.distance};
}

}  // namespace

double implied_gap(const HeldPoint& point, const EdgeContacts& edges, const NearEdges& near, const Pose& H_WS,
                   double margin, double tolerance) noexcept {
  constexpr std::size_t kMostSeen = 16;  // chosen: few pairs share the edge that is nearest to a point
  constexpr double kNearPlace = 4.0;     // margins, chosen
  const Vector3& p = point.position_W;
  std::array<SeenPair, kMostSeen> seen;
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < near.count && count < kMostSeen; ++k) {
    if (!near.gap[k].is_nearest || near.gap[k].distance > point.distance + margin) continue;
    const SeenPair pair = seen_from(point, edges, near, k, H_WS);
    if (std::fabs(distance_to(pair.other, p) - pair.other.radius - point.distance) > tolerance) continue;
    const bool do_cross = cross(pair.own, pair.other);
    const bool is_on_own = std::fabs(distance_to(pair.own, p) - pair.own.radius) <= tolerance;
    if (is_on_own && (do_cross || (p - pair.on_own).norm() <= kNearPlace * margin)) return pair.gap;
    if (do_cross) seen[count++] = pair;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double place = place_of(seen[i].other, p);
    for (std::size_t j = i + 1; j < count; ++j) {
      if (seen[j].number != seen[i].number) continue;
      const auto [first, last] = std::minmax(seen[i].place_on_other, seen[j].place_on_other);
      if (first <= place && place <= last && share_a_face(seen[i].own, seen[j].own, p, tolerance)) {
        return std::min(seen[i].gap, seen[j].gap);
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace godobject::detail
