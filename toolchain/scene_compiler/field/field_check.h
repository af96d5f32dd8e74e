#pragma once

#include <cstdint>

#include "core/scene/voxelmap.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Errors at a subset of the points. The floor is the error of trilinear interpolation between exact distances at the
/// lattice's nodes: the field without refinement.
struct ErrorNorms {
  std::uint64_t points = 0;
  double rms = 0.0;            ///< of the stored field [m]
  double largest = 0.0;        ///< [m]
  double floor_rms = 0.0;      ///< of trilinear interpolation [m]
  double floor_largest = 0.0;  ///< [m]
};

/// Error of the field against the exact distance at fresh random points within the band.
struct FieldError {
  std::uint64_t points = 0;
  double rms = 0.0;            ///< of the stored field [m]
  double largest = 0.0;        ///< [m]
  double floor_rms = 0.0;      ///< of trilinear interpolation [m]
  double floor_largest = 0.0;  ///< [m]
  /// Points on the wrong side although farther than a tenth of a voxel from the surface.
  std::uint64_t sign_errors = 0;
  std::uint64_t floor_sign_errors = 0;
  ErrorNorms near{};                 ///< at points nearer than half a voxel to the surface, off seams
  double largest_node_error = 0.0;   ///< of a stored value at the nodes around those points [m]
  double largest_node_excess = 0.0;  ///< the same beyond the rounding of the exact value to float [m]
};

/// Measures the error at `points` random points. `field` is the core's view of `grid`. Deterministic.
FieldError check_field(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field,
                       std::uint64_t points, const parallel::Progress& progress);

/// Time of Voxelmap::sample at random points of the band [ns].
struct LookUpTime {
  double unrefined = 0.0;
  double refined = 0.0;  ///< in refined positions; 0 if there are none
};
LookUpTime time_look_ups(const DistanceGrid& grid, const Voxelmap& field);

/// Throws Failure (kInternal) if a node is off by more than its rounding (format::kMostRoundedOff) and the smaller of
/// 1e-5 m and a thousandth of a voxel. Nodes on the faces of octants do not count: they may have the value of a coarser
/// brick.
void require_exact_nodes(const FieldError& error, const format::Grid& grid);

}  // namespace godobject::scene_compiler
