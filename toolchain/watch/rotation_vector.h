#pragma once

#include <cmath>

#include "godobject/pose.h"
#include "toolchain/watch/least_distance.h"

namespace godobject::watch {

/// Returns the rotation vector of a unit quaternion [rad], by the tangent of the half angle. The watch's own.
inline Vector3 rotation_vector(const Quaternion& q) {
  const double sine = q.vec().norm();
  if (sine == 0.0) return Vector3::Zero();
  const double angle = 2.0 * std::atan2(sine, std::fabs(q.w()));
  return (q.w() < 0.0 ? -angle : angle) / sine * q.vec();
}

/// Returns (first, second) as one vector.
inline Vector6 stacked(const Vector3& first, const Vector3& second) {
  Vector6 v;
  v << first, second;
  return v;
}

}  // namespace godobject::watch
