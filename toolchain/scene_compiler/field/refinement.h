#pragma once

#include <array>
#include <cstdint>

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

struct RefinementReport {
  std::array<std::uint64_t, format::kMaxRefinement + 1>
      bricks{};               ///< in which octants are looked up that are not halved, by how often they were themselves
  std::uint64_t refined = 0;  ///< bricks of which octants were halved
  std::uint64_t finer = 0;    ///< bricks stored beside those of the positions
  std::uint64_t edges = 0;    ///< stretches of straight edges along which the field is exact

  /// What they take in the image.
  std::uint64_t bytes() const { return finer * sizeof(format::Brick) + refined * sizeof(format::Refined); }
};

/// Tolerances: how far outside of the surface the stored one may be.
inline constexpr double kHeldOff = 5.0;

/// Makes `field` true to the surface of a solid, or the offset surface of a shell.
///
/// Straight edges of solids that trilinear interpolation misses are stored as such (format::Edge). For that bricks are
/// halved until none names two of them, and where the way to an edge's exact distance would be too steep.
///
/// What is still missed is refined: octants of bricks are halved, down to format::kMaxRefinement times, where the field
/// says free at more than `tolerance` [m] (convex edges and corners, thin walls, which a touching body would sink into)
/// or solid at more than kHeldOff times as much (re-entrant edges, narrow gaps, where it would be held off). Judged on
/// the surface itself, where the exact distance is 0, at all edges and vertices of the mesh and in between at a cell's
/// spacing; that of a dilated body, which has no mesh, in the middle of all cells about it. A neighbour is halved only
/// where its values on the common face spoil the finer brick's or are too steep for it. Left as they are: bricks that
/// hold a seam, and those in which one would appear.
///
/// At last all distances are made larger by `slack` [m], the body smaller, and rounded to what the image can hold.
///
/// Deterministic. Updates the constants of `field.grid` with it. Throws Failure (kBadData) naming the cure where the
/// bricks would be more than kMaxBricks.
RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, double tolerance,
                        const parallel::Progress& progress, double slack = 0.0);

/// The same of a field that is left as coarse as it is.
void round_distances(DistanceGrid& field);

}  // namespace godobject::scene_compiler
