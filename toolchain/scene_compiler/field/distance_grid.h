#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/brick.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Where the sign of an open mesh jumps without a surface.
struct SeamReport {
  std::uint64_t cells =
      0;  ///< stored cells with an edge along which the distance changes by more than the edge is long
  double largest_jump = 0.0;                     ///< [m]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< of the largest jump
};

/// A body's field: `bricks` as packed_bricks packs them once it is rounded, the rest as it goes into the image.
struct DistanceGrid {
  format::Grid grid{};
  std::vector<std::uint32_t> index;
  std::vector<Brick> bricks;
  std::vector<format::Refined> refined;
  std::vector<format::Edge> edges;
  std::vector<double> far_clearance;  ///< of far positions outside: bound of the field about their centres [m]
  std::vector<bool> beside_seam;      ///< of bricks that are a position's own: a seam is in it or touches it
  SeamReport seams;
};

/// Largest grid: brick positions (4 bytes each) and stored bricks (256 bytes each).
inline constexpr std::uint64_t kMaxBrickPositions = 1u << 27;
inline constexpr std::uint64_t kMaxBricks = 1u << 23;

/// Largest error of trilinear interpolation of a distance, in voxels: half a cell's diagonal, rounded up.
inline constexpr double kInterpolationError = 0.8661;

/// The band for a scene: it covers the safety distance and beyond it the 1.5 voxels that one sub-step may make, three
/// voxels at least; a quarter of a voxel is slack for the interpolation between nodes.
double default_band(double voxel_size, double safety_distance);

/// Exact signed distances at the nodes of all bricks that hold a node within `band` [m] or a change of sign, with
/// clearances (bound_clearances).
/// Deterministic. Throws Failure (kBadData) naming the cure if the grid would be too large or the sign does not close.
DistanceGrid make_distance_grid(const SolidSurface& surface, double voxel_size, double band,
                                const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
