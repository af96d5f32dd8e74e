#pragma once

#include <cmath>

#include "core/spatial/pose.h"
#include "core/spatial/vector.h"

namespace godobject {

/// A sphere in a body's frame, around what is of interest of it.
struct BoundingSphere {
  Vector3 center = Vector3::Zero();  ///< c
  double radius = 1.0;               ///< [m]
};

/// How far any point of the sphere is at most at pose H1 from where it was at H0, whatever lies between [m].
///
/// With Q = R_1 R_0' the turn by an angle a about the unit vector e, and d the way of the centre, a point at u from the
/// centre goes d + (Q - I) R_0 u. The second part is at right angles to e and no longer than 2 sin(a / 2) |u|, so the
/// whole is no longer than the root of (d . e)^2 + (|d x e| + 2 sin(a / 2) radius)^2.
inline double farthest_way(const BoundingSphere& sphere, const Pose& H0, const Pose& H1) noexcept {
  constexpr double kRounding = 1e-9;
  const Vector3 half_turn = (H1.rotation * H0.rotation.conjugate()).vec();  // sin(a / 2) e
  const Vector3 way = H1 * sphere.center - H0 * sphere.center;
  const double turned = 2.0 * sphere.radius;
  const double squared =
      way.squaredNorm() + 2.0 * turned * way.cross(half_turn).norm() + turned * turned * half_turn.squaredNorm();
  const double farthest = std::sqrt(squared);
  return farthest + kRounding * (farthest + sphere.radius);
}

/// How far any point of the sphere goes at most in the motion (x, r); in (s x, s r) at most s times that, s <= 1 [m].
///
/// As `farthest_way` with d = x + r x c, but for what (exp r) c - c - r x c adds: no more than |r|^2 |c| / 2.
inline double travel(const BoundingSphere& sphere, const Motion& motion) noexcept {
  const Vector3 way = motion.translation + motion.rotation.cross(sphere.center);
  const double squared_turn = motion.rotation.squaredNorm();
  const double squared = way.squaredNorm() + 2.0 * sphere.radius * way.cross(motion.rotation).norm() +
                         sphere.radius * sphere.radius * squared_turn;
  return std::sqrt(squared) + 0.5 * squared_turn * sphere.center.norm();
}

}  // namespace godobject
