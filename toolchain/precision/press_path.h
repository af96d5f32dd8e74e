#pragma once

#include "toolchain/precision/exact_scene.h"

namespace godobject::precision {

/// Motions for a scene of which nothing is known: from several sides, turned at random (fixed seed), the body comes
/// until it touches, is pressed three voxels deep, slides to and fro by ten voxels while it turns, and is lifted off.
/// None where the body meets nothing from any side.
Paths press_paths(const ExactScene& exact);

}  // namespace godobject::precision
