#pragma once

#include <type_traits>

#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/voxelmap.h"

namespace godobject {

/// The second direction: feature points of the still body against the moving body's distance.
template <DistanceField BodyField>
struct FeatureContacts {
  const BodyField* map = nullptr;  ///< in S; null: there is no second direction
  Pointshell points;               ///< in W, relative to `origin_W`
  Vector3 origin_W = Vector3::Zero();
  double body_radius = 0.0;  ///< no point of the moving body's surface is farther from its sphere's centre [m]
};

/// The field of a moving body in a build that leaves out the second direction. The compiler then drops all code for it.
struct NoBodyField : Voxelmap {};

template <class BodyField>
inline constexpr bool kHasSecondDirection = !std::is_same_v<BodyField, NoBodyField>;

}  // namespace godobject
