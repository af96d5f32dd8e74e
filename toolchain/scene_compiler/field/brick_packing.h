#pragma once

#include <vector>

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// The bricks of a field that is rounded (BrickTree::round), as the image holds them. Throws Failure (kBadData) where a
/// brick's number of an edge, its slope or its deviation does not fit, or the quantum is too large.
std::vector<format::Brick> packed_bricks(const DistanceGrid& field);

}  // namespace godobject::scene_compiler
