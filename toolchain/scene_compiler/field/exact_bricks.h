#pragma once

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// Leaves out of a field the exact bricks that no brick names, the sets of facets that no exact brick has, and the
/// facets that no set has. Renumbers bricks and sets in the order of the bricks, and facets in their own order.
void leave_out_unnamed(DistanceGrid& field);

}  // namespace godobject::scene_compiler
