#pragma once

#include <cmath>

#include <Eigen/Geometry>

namespace godobject {

using Vector3 = Eigen::Vector3d;  ///< column of three doubles
using Matrix3 = Eigen::Matrix3d;  ///< 3 x 3 doubles

/// A rigid motion (x, r) as the paper writes it: translation, then rotation vector, both in one frame. A name or
/// comment says where it is a velocity [m/s, rad/s]. It is the pair of the paper's `setMatrix` and
/// `getTranslation`/`getRotation`, NOT the SE(3) logarithm.
struct Motion {
  Vector3 translation = Vector3::Zero();  ///< x [m]
  Vector3 rotation = Vector3::Zero();     ///< r: unit axis times angle [rad]
};

/// A wrench: force, then torque, both in one frame and about one point. [N, Nm] unless a comment says otherwise.
struct Wrench {
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 torque = Vector3::Zero();  ///< [Nm]
};

using Quaternion = Eigen::Quaterniond;  ///< of unit length, unless a function says otherwise

/// Returns the unit quaternion of a rotation vector r [rad]; exact to rounding for every angle, 0 included.
inline Quaternion exp_rotation(const Vector3& r) noexcept {
  const double angle_squared = r.squaredNorm();
  // sin(a/2)/a; below 1e-4 rad the series is exact to 1e-18: the next term is a^4 / 3840 < 1e-19
  const double angle = std::sqrt(angle_squared);
  const double half_sinc = angle_squared < 1e-8 ? 0.5 - angle_squared / 48.0 : std::sin(0.5 * angle) / angle;
  const double w = angle_squared < 1e-8 ? 1.0 - angle_squared / 8.0 : std::cos(0.5 * angle);
  return Quaternion(w, half_sinc * r.x(), half_sinc * r.y(), half_sinc * r.z());
}

/// Returns the rotation vector of a unit quaternion of either sign; its length is in [0, pi] [rad].
inline Vector3 log_rotation(const Quaternion& q) noexcept {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const double sine = q.vec().norm();
  // a/sin(a/2); the series near 0 avoids 0/0 and neglects 3 sin^4(a/2) / 20 < 2e-21
  const double scale = sine < 1e-5 ? 2.0 + sine * sine / 3.0 : 2.0 * std::atan2(sine, w) / sine;
  return sign * scale * q.vec();
}

/// The pose of a frame B in a frame A, named `H_AB`: p_A = H_AB * p_B. Neighbouring letters of a product cancel.
/// Every product normalises the rotation, so a long session does not drift.
struct Pose {
  Quaternion rotation = Quaternion::Identity();  ///< R_AB, of unit length
  Vector3 translation = Vector3::Zero();         ///< origin of B, in A [m]

  /// Returns p_A = H_AB * p_B [m].
  Vector3 operator*(const Vector3& p) const noexcept { return rotation._transformVector(p) + translation; }

  /// Returns H_AC = H_AB * H_BC.
  Pose operator*(const Pose& other) const noexcept {
    Pose product;
    product.rotation = rotation * other.rotation;
    product.rotation.coeffs() /= product.rotation.norm();
    product.translation = rotation._transformVector(other.translation) + translation;
    return product;
  }

  /// Returns H_BA.
  Pose inverse() const noexcept {
    Pose inverted;
    inverted.rotation = rotation.conjugate();
    inverted.translation = -inverted.rotation._transformVector(translation);
    return inverted;
  }

  /// Tells whether all seven numbers are equal. The quaternions q and -q are one rotation but not equal.
  bool operator==(const Pose& other) const noexcept {
    return rotation.coeffs() == other.rotation.coeffs() && translation == other.translation;
  }

  /// Tells whether no number is NaN or infinite.
  bool is_finite() const noexcept { return rotation.coeffs().allFinite() && translation.allFinite(); }
};

/// Returns the paper's `setMatrix(x, r)`: the pose that rotates by r and translates by x, both in the moving frame. A
/// body at H is moved by H <- H * set_matrix(xi).
inline Pose set_matrix(const Motion& xi) noexcept {
  Pose pose;
  pose.rotation = exp_rotation(xi.rotation);
  pose.translation = xi.translation;
  return pose;
}

/// Returns the motion (x, r) of a pose: the inverse of `set_matrix`, the paper's getTranslation and getRotation.
inline Motion get_motion(const Pose& pose) noexcept { return {pose.translation, log_rotation(pose.rotation)}; }

static_assert(alignof(Pose) == 16, "compile with EIGEN_MAX_STATIC_ALIGN_BYTES=16, as the target godobject::core does");

}  // namespace godobject
