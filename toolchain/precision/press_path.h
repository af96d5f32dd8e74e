#pragma once

#include "toolchain/precision/exact_scene.h"

namespace godobject::precision {

/// Returns motions for an unknown scene. From several sides and in random orientation (fixed seed) the body approaches
/// until it touches, is pressed three voxels deep, slides back and forth by ten voxels while it turns, and is lifted
/// off. Empty if the body meets nothing from any side.
Paths press_paths(const ExactScene& exact);

}  // namespace godobject::precision
