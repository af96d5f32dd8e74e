#pragma once

#include <algorithm>

#include "godobject/pose.h"

namespace godobject {

/// A sphere in a body's frame, around what is of interest of it.
struct BoundingSphere {
  Vector3 center = Vector3::Zero();  ///< c
  double radius = 1.0;               ///< [m]
};

/// How far any point of the sphere is at most at pose H1 from where it was at H0, whatever lies between [m]: the way of
/// its centre and 2 sin(angle / 2) radius. `center0`, `center1`: H0 c, H1 c.
inline double farthest_way(const BoundingSphere& sphere, const Pose& H0, const Vector3& center0, const Pose& H1,
                           const Vector3& center1) noexcept {
  constexpr double kRounding = 1e-9;
  const Vector3 half_turn = (H1.rotation * H0.rotation.conjugate()).vec();  // as long as sin(angle / 2)
  const double way = (center1 - center0).norm() + 2.0 * sphere.radius * half_turn.norm();
  return way + kRounding * (way + sphere.radius);
}
inline double farthest_way(const BoundingSphere& sphere, const Pose& H0, const Pose& H1) noexcept {
  return farthest_way(sphere, H0, H0 * sphere.center, H1, H1 * sphere.center);
}

/// How far any point of the sphere goes at most in the motion (x, r); in (s x, s r) at most s times that, s <= 1 [m].
/// The centre goes no farther than |x| + |r| |c|, and than x + r x c and what (exp r) c - c - r x c adds: no more than
/// |r|^2 |c| / 2. Of |c| the sum of the components stands in.
inline double travel(const BoundingSphere& sphere, const Motion& motion) noexcept {
  const double turn = motion.rotation.norm();
  const double lever = turn * sphere.center.cwiseAbs().sum();
  const double short_way = (motion.translation + motion.rotation.cross(sphere.center)).norm() + 0.5 * turn * lever;
  return std::min(short_way, motion.translation.norm() + lever) + turn * sphere.radius;
}

}  // namespace godobject
