#pragma once

#include <vector>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Where the solids of a surface are nothing but two planes that meet at a crease, convex or re-entrant: the stretches
/// of their straight edges about which format::Edge's g is the surface's distance wherever w > 0, to rounding of the
/// mesh's vertices and kWrong voxels at most. That is looked at, at steps of a tenth of a voxel, all around: solids
/// within solids and thick shells leave no stretch.
///
/// Mesh edges on one line between the same two planes are one. About each stretch nothing but the two planes is nearer
/// than R / kShare, and stretches on one line are half a voxel apart, so that the tubes of different edges are. R stays
/// below `largest_radius` [m]; where it would be less than kEndRadius voxels a stretch ends. A dilated surface is round
/// and has none. Deterministic. Cost: as a
/// look at all triangles about each edge, every tenth of a voxel.
std::vector<format::Edge> straight_edges(const SolidSurface& surface, double voxel_size, double largest_radius);

inline constexpr double kShare = 0.25;      // of the way to what else is near
inline constexpr double kEndRadius = 0.25;  // voxels
inline constexpr double kWrong = 2e-3;      // voxels

/// Whether w of `edge` may be positive in the cube about `center` [m]; never wrongly false.
bool reaches(const format::Edge& edge, const Eigen::Vector3d& center, double half_edge);

}  // namespace godobject::scene_compiler
