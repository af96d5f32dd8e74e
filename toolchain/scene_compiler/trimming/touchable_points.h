#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Returns, for each sample point (in B), whether it may come near the still body while the moving body's origin is in
/// the workspace, in any orientation. A point p is |p| away from the origin. So it stays within this distance of the
/// workspace, and is nowhere nearer than this to all of it. Near means: the field, before bricks were left out, may be
/// below its band or inside. Elsewhere no solver reacts to a point. Cost: one bound for each stored cell.
std::vector<bool> within_reach_of_field(const DistanceGrid& field, const format::Workspace& workspace,
                                        std::span<const Eigen::Vector3d> points_B);

/// Returns, for each feature point (in W), whether it may come near the moving body, likewise. `body_field` is the
/// moving body's field in B.
std::vector<bool> within_reach_of_body(const DistanceGrid& body_field, const format::Workspace& workspace,
                                       std::span<const Eigen::Vector3d> points_W);

/// Returns, for each of the `points` on the surface of `body`, whether it may touch the other body: it does not lie in
/// a cavity that the other body cannot enter. Walls in which the body is deeper than `deepest` [m] separate a cavity
/// from the outside. `deepest` is the largest depth at which the bodies meet between points, so a place of the other
/// body cannot have crossed such a wall. The cavity must also be too small for any piece of the other body,
/// `least_piece` [m] long, to have started in it.
///
/// Floods the outside through a grid of at most kCavityCells^3 cells. A cell is a wall if the distance at its centre
/// proves that all of it is deeper than `deepest`. All other cells flood their 26 neighbours. So only walls some cells
/// thicker than twice `deepest` count: in doubt a point stays. Cost: one distance for each cell. A surface in one piece
/// costs nothing, because it has no cavity unless it meets itself. The same holds for an open one, where the side
/// changes without a wall.
std::vector<bool> not_sealed_off(const SolidSurface& body, std::span<const Eigen::Vector3d> points, double deepest,
                                 double least_piece);

inline constexpr int kCavityCells = 96;  ///< chosen: 0.9 million distances

/// Returns the longest edge of the bounding box of a piece of the mesh, for the piece for which it is shortest [m].
double least_piece(const TriangleMesh& mesh);

}  // namespace godobject::scene_compiler
