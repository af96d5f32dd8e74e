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

/// Bricks that were left out of a field.
struct LeftOutBricks {
  std::uint64_t positions = 0;
  std::uint64_t exact = 0;                                         ///< exact bricks
  std::uint64_t facets = 0;                                        ///< facets that no exact brick has any more
  std::uint64_t sets = 0;                                          ///< sets of facets that no cell has any more
  std::uint64_t numbers = 0;                                       ///< numbers of facets in these sets
  std::uint64_t refined = 0;                                       ///< bricks that were halved
  std::array<std::uint64_t, format::kMaxRefinement + 1> bricks{};  ///< leaf bricks, by number of halvings

  std::uint64_t all_bricks = 0;  ///< stored bricks, halved ones and octants included
  std::uint64_t bytes() const {
    return all_bricks * sizeof(format::Brick) + refined * sizeof(format::Refined) + exact * sizeof(format::ExactBrick) +
           facets * sizeof(format::Facet) + sets * sizeof(format::FacetSet) + numbers * sizeof(std::uint32_t);
  }
};

/// Returns the largest distance from the origin of B at which a cycle looks up the still body's field [m]: sample
/// points, centres of their spheres, and places on straight paths between two places of a point.
double look_up_radius(const format::Body& body, const std::vector<format::Node>& nodes);

/// Leaves out of a refined field the bricks of all positions that no look-up within `radius` [m] of the workspace
/// meets. Their index entries become "inside and far": a point that came there would be held, not let through. All
/// other bricks keep their bits, and slopes and clearances are those of the whole field, so results are the same.
/// Throws Failure (kBadConfig) naming the cure if no brick would be left.
LeftOutBricks leave_out_unreachable(DistanceGrid& field, const format::Workspace& workspace, double radius);

/// Returns the least distance from the origin of B at which a cycle looks up the moving body's field while that origin
/// is in the workspace [m]: feature points, centres of their spheres, and places on the straight path between two
/// places of a point, at most `longest_path` [m] long.
double least_look_up(const StillFeatures& features, const format::Workspace& workspace, double longest_path);

/// The same for the moving body's refined field: leaves out positions that lie entirely nearer than `least` [m] to the
/// origin. Leaves out nothing if that would be all of it.
LeftOutBricks leave_out_unreachable_core(DistanceGrid& body_field, double least);

}  // namespace godobject::scene_compiler
