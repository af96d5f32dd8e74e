#pragma once

#include <algorithm>

#include "godobject/pose.h"

namespace godobject {

/// A sphere in a body's frame that contains the body's points of interest.
struct BoundingSphere {
  Vector3 center = Vector3::Zero();  ///< c [m]
  double radius = 1.0;               ///< [m]
};

/// Returns an upper bound of the displacement of any point of the sphere between the poses H0 and H1, whatever path
/// lies between them [m]: the displacement of the centre plus 2 sin(angle / 2) radius. `center0`, `center1`: H0 c and
/// H1 c. Real-time safe.
inline double farthest_way(const BoundingSphere& sphere, const Pose& H0, const Vector3& center0, const Pose& H1,
                           const Vector3& center1) noexcept {
  constexpr double kRounding = 1e-9;  // derived: more than the rounding up to a million radii from the origin
  const Vector3 half_turn = (H1.rotation * H0.rotation.conjugate()).vec();  // of length sin(angle / 2)
  const double displacement = (center1 - center0).norm() + 2.0 * sphere.radius * half_turn.norm();
  return displacement + kRounding * (displacement + sphere.radius);
}
/// The same; computes both centres.
inline double farthest_way(const BoundingSphere& sphere, const Pose& H0, const Pose& H1) noexcept {
  return farthest_way(sphere, H0, H0 * sphere.center, H1, H1 * sphere.center);
}

/// Returns an upper bound of the displacement of any point of the sphere in the motion (x, r) [m]. In the motion
/// (s x, s r) with s <= 1 the displacement is at most s times that bound. Real-time safe.
///
/// The displacement of the centre is at most |x| + |r| |c|. It is also at most |x + r x c| plus the remainder
/// |(exp r) c - c - r x c| <= |r|^2 |c| / 2. The sum of the components replaces |c|, which it bounds.
inline double travel(const BoundingSphere& sphere, const Motion& motion) noexcept {
  const double turn = motion.rotation.norm();
  const double lever = turn * sphere.center.cwiseAbs().sum();
  const double of_center = (motion.translation + motion.rotation.cross(sphere.center)).norm() + 0.5 * turn * lever;
  return std::min(of_center, motion.translation.norm() + lever) + turn * sphere.radius;
}

}  // namespace godobject
