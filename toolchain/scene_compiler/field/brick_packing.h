#pragma once

#include <vector>

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// Returns the bricks of a rounded field (BrickTree::round) in their stored form. Throws Failure (kBadData) if the
/// number of a brick's edge, its slope or its deviation does not fit, or if the quantum is too large.
std::vector<format::Brick> packed_bricks(const DistanceGrid& field);

}  // namespace godobject::scene_compiler
