#pragma once

#include <cstdint>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/edge_certificate.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/second_look.h"
#include "core/scene/sharp_edges.h"
#include "godobject/pose.h"

/// The rows of edge against edge: the nearest point of the moving edge has to move along the gap's normal.
namespace godobject::detail {

/// Appends the rows of near pairs, unless a face is nearer, while there is room; returns how many found none. Pairs
/// within a margin have a row all the same: the stored field, less exact than the edges, may leave the face no points
/// that hold, and the certificate would stop the body at the edge for good. H: pose of S in W. Real-time safe.
inline std::uint32_t push_edges(const Pose& H, const ContactLengths& lengths, const NearEdges& near,
                                ContactRows& rows) noexcept {
  const GapLaw law = lengths.gap_law();
  const Pose to_S = H.inverse();
  std::uint32_t dropped = 0;
  for (std::uint32_t k = 0; k < near.count; ++k) {
    const EdgeGap& gap = near.gap[k];
    if (!gap.is_nearest && gap.distance > lengths.margin) continue;
    if (rows.full()) {
      ++dropped;
      continue;
    }
    rows.push(id_of(near.pair[k]), to_S.rotation._transformVector(gap.normal), to_S * gap.on_moving,
              law.required_gain(lengths.margin - gap.distance));
  }
  return dropped;
}

/// Adds the row of a pair that a motion met, as push_obstacle. False: there is no room, or the gap has no direction.
/// Real-time safe.
inline bool push_edge_obstacle(const Attempt& attempt, const ContactLengths& lengths, const EdgeContacts& edges,
                               const NearEdges& near, const EdgeObstacle& obstacle, ContactRows& rows) noexcept {
  if (rows.full() || obstacle.gap.normal.isZero(0.0)) return false;
  const format::SharpEdge& edge = edges.moving.edges[near.pair[obstacle.near].moving];
  const Vector3 p = edge_end(edge, 0) + obstacle.gap.place * (edge_end(edge, 1) - edge_end(edge, 0));
  const Vector3 displacement = obstacle.share * (attempt.H1 * p - attempt.H0 * p);
  const Vector3 normal_S = attempt.H0.rotation.conjugate()._transformVector(obstacle.gap.normal);
  double loss = 0.0;
  if (attempt.is_arc) {
    const Motion& step = attempt.step;
    const double promised = attempt.share * obstacle.share * normal_S.dot(step.translation + step.rotation.cross(p));
    loss = (promised - obstacle.gap.normal.dot(displacement)) / attempt.share;
  }
  const FieldSample at_obstacle{.distance = obstacle.gap.distance, .gradient = obstacle.gap.normal, .known = true};
  rows.push(id_of(near.pair[obstacle.near]), normal_S, p,
            second_look_gain(lengths, at_obstacle, displacement, near.gap[obstacle.near].distance, 1.0, loss));
  return true;
}

}  // namespace godobject::detail
