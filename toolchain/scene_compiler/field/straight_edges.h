#pragma once

#include <vector>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Finds stretches of straight edges, convex or re-entrant, at which the solids of a surface are nothing but two planes
/// that meet at a crease. On these stretches format::Edge's g is the distance of the surface wherever w > 0, within
/// kWrong voxels and the rounding of the mesh's vertices. That is tested all around at steps of a tenth of a voxel. So
/// solids within solids and thick shells leave no stretch.
///
/// Mesh edges on one line between the same two planes are one edge. About each stretch, nothing but the two planes is
/// nearer than R / kShare. Stretches on one line are half a voxel apart, so the tubes of different edges are apart too.
/// R stays below `largest_radius` [m]. A stretch ends where R would be less than kEndRadius voxels. A dilated surface
/// is round and has no such edges. Deterministic. Cost: a search among all triangles about each edge, every tenth of a
/// voxel.
std::vector<format::Edge> straight_edges(const SolidSurface& surface, double voxel_size, double largest_radius);

/// Largest R, of the distance from the edge to other parts of the surface. g is the surface's distance if R is at most
/// half of it. A quarter leaves room for bricks between the tubes of two edges.
inline constexpr double kShare = 0.25;
inline constexpr double kEndRadius = 0.25;  ///< least R [voxels]: the edge of a finest brick
inline constexpr double kWrong = 2e-3;      ///< error of g [voxels]: a 25th of the default field_tolerance

/// True if w of `edge` may be positive in the cube about `center` [m]. Never wrongly false.
bool reaches(const format::Edge& edge, const Eigen::Vector3d& center, double half_edge);

}  // namespace godobject::scene_compiler
