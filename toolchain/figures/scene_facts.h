#pragma once

#include <string>

#include "core/scene/scene.h"

namespace godobject::figures {

/// What a compiled scene is made of, in a sentence: voxels, points of both bodies, levels, friction.
std::string scene_facts(const Scene& scene);

}  // namespace godobject::figures
