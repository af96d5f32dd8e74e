#pragma once

#include <array>
#include <cstdint>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/points/still_features.h"

namespace godobject::scene_compiler {

/// Distance that trimming adds to every bound: a look-up in single precision may take the neighbouring position for the
/// one that its point is in [voxels].
inline constexpr double kLookUpSlack = 1.0;

/// What was left out of a field.
struct LeftOutBricks {
  std::uint64_t positions = 0;
  std::uint64_t edges = 0;                                         ///< straight ones that no brick names any more
  std::uint64_t refined = 0;                                       ///< bricks halved
  std::array<std::uint64_t, format::kMaxRefinement + 1> bricks{};  ///< that were looked up, by how often halved

  std::uint64_t all_bricks = 0;  ///< as they were stored, halved ones and octants included
  std::uint64_t bytes() const {
    return all_bricks * sizeof(format::Brick) + refined * sizeof(format::Refined) + edges * sizeof(format::Edge);
  }
};

/// Largest distance from the origin of B at which a cycle looks anything up in the still body's field: sample points,
/// centres of their spheres, and places on straight ways between two places of a point [m].
double look_up_radius(const format::Body& body, const std::vector<format::Node>& nodes);

/// Leaves out of a finished field (after `refine`) the bricks of all positions that no look-up within `radius` [m] of
/// the workspace meets. What stands in the index in their place counts as inside and far: a point that came there would
/// be held, not let through. Everything else keeps its bits, so results are the same: slopes and clearances are those
/// of the whole field. Throws Failure (kBadConfig) naming the cure where nothing would be left.
LeftOutBricks leave_out_unreachable(DistanceGrid& field, const format::Workspace& workspace, double radius);

/// Least distance from the origin of B at which a cycle looks anything up in the moving body's field while that origin
/// is in the workspace: feature points, centres of their spheres, and places on the straight way between two places of
/// a point, no longer than `longest_way` [m].
double least_look_up(const StillFeatures& features, const format::Workspace& workspace, double longest_way);

/// The same for the moving body's finished field: positions all of which lie nearer than `least` [m] to the origin.
/// Nothing goes where all of it is to go.
LeftOutBricks leave_out_unreachable_core(DistanceGrid& body_field, double least);

}  // namespace godobject::scene_compiler
