#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Which sample points (in B) may come near the still body while the moving body's origin is in the workspace, however
/// it is turned: a point p is |p| from the origin, so it does not leave the places that are no farther than this from
/// the workspace, and no nearer than this to the whole of it. Near is where the field, as it was before bricks were
/// left out, may be below its band or is inside; elsewhere no solver feels a point. Cost: a bound a stored cell.
std::vector<bool> within_reach_of_field(const DistanceGrid& field, const format::Workspace& workspace,
                                        std::span<const Eigen::Vector3d> points_B);

/// Which feature points (in W) may come near the moving body, likewise, `body_field` its field in B.
std::vector<bool> within_reach_of_body(const DistanceGrid& body_field, const format::Workspace& workspace,
                                       std::span<const Eigen::Vector3d> points_W);

/// Which `points` on the surface of `body` lie in no cavity of it that the other body cannot be in. A cavity is parted
/// from the outside by walls in which the body is deeper than `deepest` [m], the most that the bodies meet between
/// points: a place of the other body that got from one side to the other would have been deeper on its way. It is also
/// too small for any one piece of the other body, `least_piece` [m] long, to have begun in it.
///
/// By a flood of the outside through a grid of at most kCavityCells^3 cells. A cell is a wall where the distance at its
/// centre says that all of it is deeper than `deepest`; all else floods its 26 neighbours. So only walls some cells
/// thicker than twice `deepest` count: in doubt a point stays. Cost: a distance a cell; nothing where the surface is in
/// one piece, which holds no cavity unless it meets itself, or open, so that the side changes without a wall.
std::vector<bool> not_sealed_off(const SolidSurface& body, std::span<const Eigen::Vector3d> points, double deepest,
                                 double least_piece);

inline constexpr int kCavityCells = 96;

/// Longest edge of the bounding box of the piece of the mesh for which it is shortest [m].
double least_piece(const TriangleMesh& mesh);

}  // namespace godobject::scene_compiler
