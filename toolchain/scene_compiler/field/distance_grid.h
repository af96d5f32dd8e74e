#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/facets.h"
#include "core/scene/format.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/brick.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Seams: places where the sign of an open mesh jumps without a surface.
struct SeamReport {
  /// Stored cells with an edge along which the distance changes by more than the edge's length.
  std::uint64_t cells = 0;
  double largest_jump = 0.0;                     ///< [m]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< place of the largest jump
};

/// The field of a body: bricks before packing (packed_bricks), everything else as the image stores it.
struct DistanceGrid {
  format::Grid grid{};
  std::vector<std::uint32_t> index;
  std::vector<Brick> bricks;
  std::vector<format::Refined> refined;
  std::vector<format::ExactBrick> exact;
  std::vector<format::Facet> facets;
  std::vector<format::FacetSet> facet_sets;
  std::vector<std::uint32_t> facet_numbers;
  std::vector<double> far_clearance;  ///< of far positions outside: bound of the distance at their centres [m]
  std::vector<bool> beside_seam;      ///< of each position's own brick: a seam lies in it or touches it
  SeamReport seams;

  FacetLists facet_lists() const { return {facets, facet_sets, facet_numbers}; }
};

/// Limits of a grid. 2^27 positions of 4 bytes and 2^23 bricks of 256 bytes take 0.5 and 2 GiB of the image.
inline constexpr std::uint64_t kMaxBrickPositions = 1u << 27;
inline constexpr std::uint64_t kMaxBricks = 1u << 23;

/// Largest error of trilinear interpolation of a distance [voxels]: half the diagonal of a cell, rounded up, because a
/// distance changes by at most 1 per length.
inline constexpr double kInterpolationError = 0.8661;

/// Returns the band for a scene: the safety distance plus 1.5 voxels for the longest sub-step, at least three voxels,
/// and a quarter of a voxel for the interpolation between nodes.
double default_band(double voxel_size, double safety_distance);

/// Returns the exact signed distances at the nodes of all bricks that contain a node within `band` [m] or a change of
/// sign, with clearances (bound_clearances). Deterministic. Throws Failure (kBadData) naming the cure if the grid would
/// be too large or the mesh encloses space outside its bounds.
DistanceGrid make_distance_grid(const SolidSurface& surface, double voxel_size, double band,
                                const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
