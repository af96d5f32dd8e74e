#pragma once

#include <vector>

#include "toolchain/scene_compiler/field/brick_lattice.h"

namespace godobject::scene_compiler {

/// Returns the exact squared distance of every position to the nearest one in `set`, in steps. `set` must not be empty.
std::vector<float> squared_distance_transform(const BrickLattice& lattice, const std::vector<bool>& set);

}  // namespace godobject::scene_compiler
