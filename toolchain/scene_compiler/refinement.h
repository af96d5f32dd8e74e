#pragma once

#include <array>
#include <cstdint>

#include "toolchain/scene_compiler/distance_grid.h"

namespace godobject::scene_compiler {

struct RefinementReport {
  std::array<std::uint64_t, format::kMaxRefinement + 1>
      bricks{};               ///< that are looked up, by how often they were halved
  std::uint64_t refined = 0;  ///< bricks halved

  /// What the octants take in the image.
  std::uint64_t bytes() const { return refined * (8 * sizeof(format::Brick) + sizeof(format::Refined)); }
};

/// Halves the bricks of `field` where the stored distance misses the surface of a solid, or the offset surface of a
/// shell, by more than `tolerance` [m], down to format::kMaxRefinement times: sharp edges, corners, thin walls and
/// narrow gaps. Judged on the surface itself, where the exact distance is 0, at all edges and vertices of the mesh and
/// in between at half a cell's spacing. Neighbouring bricks differ by one halving at most. Left as they are: bricks
/// that touch a seam, and those in which one would appear.
///
/// Deterministic. Updates the constants of `field.grid` with it. Throws Failure (kBadData) naming the cure where the
/// bricks would be more than kMaxBricks.
RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, double tolerance, const Progress& progress);

}  // namespace godobject::scene_compiler
