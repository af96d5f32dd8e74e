#pragma once

#include <algorithm>

#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/search/near_points.h"

/// The second look: the surface at an obstacle becomes one more row of the point that met it. Where two faces of the
/// field meet in a valley, the gradient at the start of the motion describes only one of them.
namespace godobject::detail {

/// Returns the required gap increase of the new row [m]. `displacement`: from the start of the chord to the obstacle,
/// in the field's frame [m]; `start_distance`: stored distance at the start [m]; `steepness`: length of the gradient at
/// the obstacle [1]. The row requires no more than the point's row at the start, so that rest remains feasible.
inline double second_look_gain(const ContactLengths& lengths, const FieldSample& at_obstacle,
                               const Vector3& displacement, double start_distance, double steepness) noexcept {
  // extrapolated to the start, the distance differs by the gradient times the displacement
  const double gain = (lengths.margin - at_obstacle.distance + at_obstacle.gradient.dot(displacement)) / steepness;
  return std::min(gain, std::max(0.0, kRecovery * (lengths.margin - start_distance)));
}

/// Adds the row of an obstacle in a motion from H0 to H1. False: there is no room for a row, or the field has no
/// gradient at the obstacle. Real-time safe.
template <class Direction>
bool push_obstacle(const Pose& H0, const Pose& H1, const ContactLengths& lengths, const NearPoints& near,
                   const Obstacle& obstacle, ContactRows& rows) noexcept {
  if (rows.full() || !obstacle.sample.known || !(obstacle.sample.gradient.norm() > kFlat)) return false;
  const Matrix3 R0 = H0.rotation.toRotationMatrix();
  const Vector3 p = near.point(obstacle.near);
  const Vector3 p0 = R0 * p + H0.translation;
  const Vector3 displacement = obstacle.share * (H1 * p - p0);
  const ContactPoint contact = Direction::contact(p, p0, obstacle.sample.gradient, R0);
  const double steepness = contact.gradient_S.norm();
  rows.push(Direction::kId | near.index[obstacle.near], contact.gradient_S / steepness, contact.point_S,
            second_look_gain(lengths, obstacle.sample, displacement, near.distance[obstacle.near], steepness));
  return true;
}

}  // namespace godobject::detail
