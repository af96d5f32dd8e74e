#pragma once

#include <type_traits>

#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/voxelmap.h"

namespace godobject {

/// The second direction: feature points of the still body in the moving body's field.
template <DistanceField BodyField>
struct FeatureContacts {
  const BodyField* map = nullptr;      ///< the moving body's field, in S; null: there is no second direction
  Pointshell points;                   ///< feature points, along the axes of W, relative to `origin_W` [m]
  Vector3 origin_W = Vector3::Zero();  ///< [m]
  double body_radius = 0.0;            ///< largest distance of the moving body's surface from its sphere's centre [m]
};

/// The body field of a build that leaves out the second direction; the compiler then removes all code for it.
struct NoBodyField : Voxelmap {};

/// True if a build with this body field has the second direction.
template <class BodyField>
inline constexpr bool kHasSecondDirection = !std::is_same_v<BodyField, NoBodyField>;

}  // namespace godobject
