#pragma once

#include <array>
#include <cstdint>

#include "toolchain/scene_compiler/field/brick.h"
#include "toolchain/scene_compiler/field/brick_tree.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// The eight octants of a brick with exact distances at their nodes.
struct Octants {
  std::array<Brick, 8> bricks{};
  bool seamed = false;  ///< one of them holds a seam
};

/// Measures the distances at the nodes of the octants of `brick`.
Octants measure_octants(const SolidSurface& surface, const BrickTree& tree, std::uint32_t brick);

/// True if a cell of the brick lies on a seam. `cell_edge` [m].
bool holds_seam(const Brick& brick, double cell_edge);

}  // namespace godobject::scene_compiler
