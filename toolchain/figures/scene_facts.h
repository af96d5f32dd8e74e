#pragma once

#include <string>

#include "core/scene/scene_view.h"

namespace godobject::figures {

/// Returns a sentence about a compiled scene: voxels, points of both bodies, levels, friction.
std::string scene_facts(const SceneView& scene);

}  // namespace godobject::figures
