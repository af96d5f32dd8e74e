#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/scene/field.h"
#include "core/scene/sample_batch.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

/// The two directions of contact: sample points of the moving body in the still body's field, and feature points of the
/// still body in the moving body's field. Each direction is a type with the same members, for templates.
namespace godobject::detail {

/// The bit of a contact's id that marks a feature point.
inline constexpr std::uint32_t kFeature = 1u << 31;

/// A contact between a point P and a surface whose distance grows along `gradient_S` as P moves.
struct ContactPoint {
  Vector3 point_S;     ///< P, in S [m]
  Vector3 gradient_S;  ///< in S, not normalised [1]
};

/// Returns the matrix M with M p = r x p.
inline Matrix3 cross_matrix(const Vector3& r) noexcept {
  Matrix3 M;
  M << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  return M;
}

/// The displacement of points in the field's frame, to first order in a motion: a point p of the shell moves by `turn`
/// p
/// + `shift`.
struct ShellDisplacement {
  Matrix3 turn;   ///< [1]
  Vector3 shift;  ///< [m]
};

/// The first direction: sample points move with S, the field rests in W.
struct SampleDirection {
  static constexpr std::uint32_t kId = 0;
  static constexpr bool kStretches = false;

  /// Returns the pose of the shell's frame in the field's frame.
  static Pose pose(const Pose& H_WS, const Vector3& /*origin_W*/) noexcept { return H_WS; }
  /// Returns the contact at a point, given in the shell's and in the field's frame [m], with the field's gradient
  /// there.
  static ContactPoint contact(const Vector3& p_shell, const Vector3& /*p_field*/, const Vector3& gradient,
                              const Matrix3& R_field_shell) noexcept {
    return {p_shell, R_field_shell.transpose() * gradient};
  }
  /// Returns the displacement by a motion (x, r) of S: R (x + r x p). `H`: pose of the shell in the field's frame.
  static ShellDisplacement displacement(const Pose& H, const Motion& motion) noexcept {
    const Matrix3 R = H.rotation.toRotationMatrix();
    return {R * cross_matrix(motion.rotation), R * motion.translation};
  }
  /// Returns the matrix M with d(distance) = gradient . M dP for a displacement dP of P in S.
  static Matrix3 from_S(const Matrix3& R_field_shell) noexcept { return R_field_shell; }
  /// Returns point `k` of a batch that was looked up, in S [m].
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept {
    return {static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]), static_cast<double>(batch.z[k])};
  }
  /// Returns the largest ratio of a near point's displacement in the field's frame to the odometer's difference [1].
  double most_stretch() const noexcept { return 1.0; }
};

/// The second direction: feature points rest in W, the field moves with S. In S the point q is displaced by -(x + r x
/// q).
struct FeatureDirection {
  static constexpr std::uint32_t kId = kFeature;
  static constexpr bool kStretches = true;

  BoundingSphere sphere;  ///< in S; the odometer bounds the displacement of the points in it
  double near_radius =
      1.0;  ///< radius of a ball about the sphere's centre that contains all points that may be near [m]

  FeatureDirection() noexcept = default;
  FeatureDirection(const ContactLengths& lengths, double body_radius) noexcept
      : sphere(lengths.sphere), near_radius(body_radius + lengths.longest_search_radius) {}

  static Pose pose(const Pose& H_WS, const Vector3& origin_W) noexcept {
    Pose H_WF;
    H_WF.translation = origin_W;
    return H_WS.inverse() * H_WF;
  }
  static ContactPoint contact(const Vector3& /*p_shell*/, const Vector3& p_field, const Vector3& gradient,
                              const Matrix3& /*R_field_shell*/) noexcept {
    return {p_field, -gradient};
  }
  /// Returns the displacement by a motion (x, r) of S: -(x + r x H p). `H`: pose of the shell in the field's frame.
  static ShellDisplacement displacement(const Pose& H, const Motion& motion) noexcept {
    const Matrix3 turn = cross_matrix(motion.rotation);
    return {-turn * H.rotation.toRotationMatrix(), -(motion.translation + turn * H.translation)};
  }
  static Matrix3 from_S(const Matrix3& /*R_field_shell*/) noexcept { return -Matrix3::Identity(); }
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept { return stored_position(batch, k); }

  /// Returns the distance of a feature point q_S from the sphere's centre [m].
  double lever(const Vector3& q_S) const noexcept { return (q_S - sphere.center).norm(); }
  /// Returns an upper bound of the ratio of the displacement of a point at this lever to the odometer's difference [1].
  double stretch(double lever) const noexcept { return std::max(1.0, lever / sphere.radius); }
  /// Returns the largest stretch of a point that a motion within the longest search radius can bring to the body. A
  /// point farther than near_radius from the sphere's centre comes nearer only by the displacement of that centre.
  double most_stretch() const noexcept { return stretch(near_radius); }
};

}  // namespace godobject::detail
