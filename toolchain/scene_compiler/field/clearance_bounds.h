#pragma once

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// Sets the bounds on which clearances rest: Brick::lipschitz and deviation, the constants of Grid and the far entries
/// of the index. Call it again after every change of the field's values.
void bound_clearances(DistanceGrid& field);

}  // namespace godobject::scene_compiler
