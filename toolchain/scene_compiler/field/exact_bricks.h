#pragma once

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// Leaves out of a field the exact bricks that no brick names, and the facets that no exact brick has. Renumbers the
/// others in the order of the bricks, and of the facets.
void leave_out_unnamed(DistanceGrid& field);

}  // namespace godobject::scene_compiler
