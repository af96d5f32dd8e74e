#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/brick_tree.h"
#include "toolchain/scene_compiler/field/refinement.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Octants of bricks to be halved: by brick, one bit for each octant.
using Wanted = std::map<std::uint32_t, std::uint8_t>;

inline void want(Wanted& wanted, std::uint32_t brick, std::uint8_t octants) {
  std::uint8_t& of_brick = wanted[brick];
  of_brick = static_cast<std::uint8_t>(of_brick | octants);
}

/// Places at which the stored field misses the surface by more than the tolerance, or by a part of it where the surface
/// turns.
struct Misses {
  Wanted wanted;                                 ///< octants that would reduce the error
  std::map<std::uint32_t, std::uint64_t> exact;  ///< cells that should be exact: by brick, one bit each
  std::vector<std::uint32_t> triangles;          ///< with such places
  SurfaceError worst;                            ///< of the errors that no halving reduces
};

/// The work of earlier comparisons of the same tree, surface and tolerance. A place is compared again only if something
/// changed in its position or beside it, or if an error had to stay there.
struct Compared {
  /// By triangle, of a dilated surface by brick: 1 + BrickTree::joins() at the last comparison, if no error had to
  /// stay.
  std::vector<std::uint32_t> after;
};

/// Compares the stored field with the surface on `triangles`: at points of their edges, half a cell apart, and of their
/// faces, a cell apart, of a shell also about its rims and folds. A dilated surface, which has no mesh, is compared in
/// all cells about it. The error must lie within `tolerance`. With a `slack` [m] also the level so deep inside is
/// compared, where a solid touches that is made smaller by it: it must not lie deeper than the tolerance. Where the
/// surface turns, cells are asked to be exact, if the tree allows it, else octants to be halved. `barred` bricks cannot
/// be halved. `compared` begins empty; a brick that is barred later must be touched. Without it all places are
/// compared, with the same result.
Misses find_misses(const SolidSurface& surface, const BrickTree& tree, const std::vector<bool>& barred,
                   const SurfaceTolerance& tolerance, double slack, const std::vector<std::uint32_t>& triangles,
                   const parallel::Progress& progress, Compared* compared = nullptr);

}  // namespace godobject::scene_compiler
