#pragma once

#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// An upper bound of the distance that any point of the moving body has travelled in a session. Real-time safe.
class Odometer {
 public:
  /// Resets the reading to 0.
  void reset() noexcept { *this = Odometer{}; }

  /// Adds the displacement from the last pose to H_WS. All points of the body lie in `sphere` (in S), which must be the
  /// same in every call. Only the given poses count, not the path between them.
  void move_to(const Pose& H_WS, const BoundingSphere& sphere) noexcept {
    if (started_ && H_WS == H_) return;  // not even rounding is added while the body stays
    const Vector3 center = H_WS * sphere.center;
    if (started_) travelled_ += farthest_way(sphere, H_, center_, H_WS, center);
    H_ = H_WS;
    center_ = center;
    started_ = true;
  }

  /// Returns the reading [m].
  double travelled() const noexcept { return travelled_; }

 private:
  Pose H_;
  Vector3 center_ = Vector3::Zero();  ///< of the sphere at H_ [m]
  double travelled_ = 0.0;            ///< [m]
  bool started_ = false;
};

}  // namespace godobject
