#pragma once

#include <cstdint>

#include "core/scene/voxelmap.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Errors of some of the points.
struct ErrorNorms {
  std::uint64_t points = 0;
  double rms = 0.0;            ///< of the stored field [m]
  double largest = 0.0;        ///< [m]
  double floor_rms = 0.0;      ///< of trilinear interpolation between exact distances at the nodes of the lattice [m]
  double floor_largest = 0.0;  ///< [m]
};

/// How far the field is from the exact distance, on fresh random points within the band. What the floor tells is the
/// field without refinement.
struct FieldError {
  std::uint64_t points = 0;
  double rms = 0.0;               ///< of the stored field [m]
  double largest = 0.0;           ///< [m]
  double floor_rms = 0.0;         ///< of trilinear interpolation between exact values at the lattice's nodes [m]
  double floor_largest = 0.0;     ///< [m]
  std::uint64_t sign_errors = 0;  ///< wrong side although further than a tenth of a voxel from the surface
  std::uint64_t floor_sign_errors = 0;
  ErrorNorms near{};                 ///< where the exact distance is below half a voxel, off seams
  double largest_node_error = 0.0;   ///< of a stored value at the nodes around those points [m]
  double largest_node_excess = 0.0;  ///< the same beyond what rounding the exact value to float may make of it [m]
};

/// Deterministic. `field` is the view that the core has of `grid`.
FieldError check_field(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field,
                       std::uint64_t points, const parallel::Progress& progress);

/// Time of Voxelmap::sample at random points of the band, many times over [ns].
struct LookUpTime {
  double unrefined = 0.0;
  double refined = 0.0;  ///< in refined positions; 0 where there are none
};
LookUpTime time_look_ups(const DistanceGrid& grid, const Voxelmap& field);

/// Throws Failure (kInternal) if a node is off by more than what it is rounded by (format::kMostRoundedOff) and the
/// smaller of 1e-5 m and a thousandth of a voxel. Nodes on the faces of octants, which may carry a coarser brick's
/// value, do not count.
void require_exact_nodes(const FieldError& error, const format::Grid& grid);

}  // namespace godobject::scene_compiler
