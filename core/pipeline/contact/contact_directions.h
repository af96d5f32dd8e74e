#pragma once

#include <algorithm>
#include <cstdint>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/scene/field.h"
#include "core/scene/sample_batch.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

/// Contacts are found in two directions: sample points of the moving body in the still body's field, and feature points of
/// the still body in the moving body's field. Each direction is a type with the same members, for templates.
namespace godobject::detail {

/// Bit of a contact's id that marks a feature point.
inline constexpr std::uint32_t kFeature = 1u << 31;

/// A contact between a point P (in S) and a surface whose distance grows along `gradient_S` as P moves.
struct ContactPoint {
  Vector3 point_S;
  Vector3 gradient_S;
};

/// Sample points move with S; the field stands in W.
struct SampleDirection {
  static constexpr std::uint32_t kId = 0;
  static constexpr bool kStretches = false;

  /// Pose of the shell's frame in the field's frame.
  static Pose pose(const Pose& H_WS, const Vector3& /*origin_W*/) noexcept { return H_WS; }
  /// From a point of the shell (in the shell's frame, and in the field's) and the field's gradient there.
  static ContactPoint contact(const Vector3& p_shell, const Vector3& /*p_field*/, const Vector3& gradient,
                              const Matrix3& R_field_shell) noexcept {
    return {p_shell, R_field_shell.transpose() * gradient};
  }
  /// The matrix M with  d(distance) = gradient . M dP  for a displacement dP of P in S.
  static Matrix3 from_S(const Matrix3& R_field_shell) noexcept { return R_field_shell; }
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept {
    return {static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]), static_cast<double>(batch.z[k])};
  }
  double most_stretch() const noexcept { return 1.0; }
};

/// Feature points stand in W; the field moves with S. In S the point q moves by -(x + r x q).
struct FeatureDirection {
  static constexpr std::uint32_t kId = kFeature;
  static constexpr bool kStretches = true;

  BoundingSphere sphere;     ///< in S; a point in it moves no farther than the odometer's reading
  double near_radius = 1.0;  ///< of a ball about the sphere's centre that holds all points that may come near [m]

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
  static Matrix3 from_S(const Matrix3& /*R_field_shell*/) noexcept { return -Matrix3::Identity(); }
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept { return stored_position(batch, k); }

  /// Distance of a feature point from the sphere's centre, in S [m].
  double lever(const Vector3& q_S) const noexcept { return (q_S - sphere.center).norm(); }
  /// Ratio of the displacement of a point at this lever to the odometer's, at most.
  double stretch(double lever) const noexcept { return std::max(1.0, lever / sphere.radius); }
  /// Of the points that a motion within the longest search radius can bring to the body: a point farther than near_radius
  /// from the sphere's centre comes nearer only by the displacement of that centre.
  double most_stretch() const noexcept { return stretch(near_radius); }
};

}  // namespace godobject::detail
