#pragma once

#include <Eigen/Geometry>

#include "core/pipeline/contact/qp/dual_active_set.h"
#include "godobject/pose.h"

namespace godobject::detail {

/// The six coordinates in which the metric is Euclidean: z = (x, rho r) [m] for the coupling's metric, or L' z where
/// viscous friction has changed it to H = L L'.
class CouplingSpace {
 public:
  /// `gyration`: rho [m].
  explicit CouplingSpace(double gyration) noexcept : gyration_(gyration) {}

  /// Sets the metric |x|^2 + rho^2 |r|^2.
  void reset() noexcept { whitened_ = false; }
  /// Sets the metric H, in the coordinates (x, rho r), positive definite.
  void set_metric(const Matrix6& H) noexcept;

  double gyration() const noexcept { return gyration_; }

  /// Returns the gradient of push . (x + r x point), which is also the change of z by a force `push` at `point`, in S.
  Vector6 gradient(const Vector3& push, const Vector3& point) const noexcept {
    Vector6 c;
    c << push, point.cross(push) / gyration_;
    return whitened_ ? Vector6(whiten_ * c) : c;
  }
  /// Returns the sum of the gradients of two pushes.
  Vector6 gradient(const Vector3& push, const Vector3& point, const Vector3& other,
                   const Vector3& other_point) const noexcept {
    Vector6 c;
    c << push + other, (point.cross(push) + other_point.cross(other)) / gyration_;
    return whitened_ ? Vector6(whiten_ * c) : c;
  }
  /// Returns the target z of a force H (x, rho r).
  Vector6 target(const Vector6& load) const noexcept { return whitened_ ? Vector6(whiten_ * load) : load; }
  /// Returns (x, rho r) of z [m].
  Vector6 plain(const Vector6& z) const noexcept { return whitened_ ? Vector6(whiten_.transpose() * z) : z; }

  /// Returns the motion (x, r) of (x, rho r).
  Motion motion(const Vector6& plain) const noexcept { return {plain.head<3>(), plain.tail<3>() / gyration_}; }

 private:
  double gyration_;
  bool whitened_ = false;
  Matrix6 whiten_ = Matrix6::Identity();  // inverse of L
};

}  // namespace godobject::detail
