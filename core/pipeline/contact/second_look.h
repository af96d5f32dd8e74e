#pragma once

#include <algorithm>

#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/search/near_points.h"

/// A second look: the surface as it is at an obstacle becomes one more row of the point that met it. Where two faces of
/// the field meet in a valley, the gradient at the start of the motion knows only one of them.
namespace godobject::detail {

/// Required gap increase of the new row [m]. `displacement`: from the start of the chord to the obstacle, in the field's
/// frame. The row asks for no more than the point's row at the start, so that resting stays possible.
inline double second_look_gain(const ContactLengths& lengths, const FieldSample& at_obstacle,
                               const Vector3& displacement, double start_distance, double steepness) noexcept {
  // back at the start the distance differs by the gradient times the displacement
  const double gain =
      (lengths.margin - at_obstacle.distance + at_obstacle.gradient.dot(displacement)) / steepness;
  return std::min(gain, std::max(0.0, kRecovery * (lengths.margin - start_distance)));
}

/// Adds the row. False: there is no room, or the field has no gradient at the obstacle.
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
