#pragma once

#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// An upper bound on the distance that any point of the moving body has travelled in a session.
class Odometer {
 public:
  void reset() noexcept { *this = Odometer{}; }

  /// The body is at H_WS now; all its points lie in `sphere`, which is the same in every call. Only the poses that are
  /// given here count, whatever path lies between them.
  void move_to(const Pose& H_WS, const BoundingSphere& sphere) noexcept {
    const Vector3 center = H_WS * sphere.center;
    if (started_) travelled_ += farthest_way(sphere, H_, center_, H_WS, center);
    H_ = H_WS;
    center_ = center;
    started_ = true;
  }

  /// [m]
  double travelled() const noexcept { return travelled_; }

 private:
  Pose H_;
  Vector3 center_ = Vector3::Zero();  ///< of the sphere [m]
  double travelled_ = 0.0;            ///< [m]
  bool started_ = false;
};

}  // namespace godobject
