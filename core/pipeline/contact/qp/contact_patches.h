#pragma once

#include <array>
#include <cstdint>

#include "godobject/pose.h"

namespace godobject {

/// A flat face on which the body rests. The rows hold it at some of its points, mostly corners; a real face carries its
/// load all over. The friction of its points acts nearer to the load's centre, so that its torque about the normal is
/// that of a pressure that is linear over the face. In S.
struct ContactPatch {
  Vector3 normal = Vector3::Zero();  ///< unit
  Vector3 centre = Vector3::Zero();  ///< of the load [m]
  double share;                      ///< of a point's distance from the centre, at which its friction acts [1]
};

/// The faces that carried load in the last cycle.
struct ContactPatches {
  static constexpr std::uint32_t kMost = 2;  ///< chosen; the points of a third face keep their own places

  std::array<ContactPatch, kMost> patch;
  std::uint32_t count = 0;

  /// Returns the point at which the friction of a contact acts, in S [m]: the contact's own point, unless it lies on
  /// one of the faces. `thickness`: largest distance of a face's points from its plane [m].
  Vector3 grip(const Vector3& normal, const Vector3& point, double thickness) const noexcept {
    for (std::uint32_t i = 0; i < count; ++i) {
      const ContactPatch& face = patch[i];
      if (!have_one_normal(face.normal, normal)) continue;
      const Vector3 from_centre = point - face.centre;
      const double height = face.normal.dot(from_centre);
      if (height > thickness || height < -thickness) continue;
      return point - (1.0 - face.share) * (from_centre - height * face.normal);
    }
    return point;
  }

  /// Tells whether two unit normals are those of one face. Chosen: two degrees, more than those of an interpolated
  /// plane differ.
  static bool have_one_normal(const Vector3& a, const Vector3& b) noexcept { return a.dot(b) > 0.9994; }
};

}  // namespace godobject
