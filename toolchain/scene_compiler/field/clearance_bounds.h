#pragma once

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// What the field promises about clearances: Brick::lipschitz and deviation, the constants of Grid and the far entries
/// of the index. Again after every change of the field's values.
void bound_clearances(DistanceGrid& field);

}  // namespace godobject::scene_compiler
