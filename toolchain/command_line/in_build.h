#pragma once

#include <string>

#include "core/pipeline/cycle/scene_traits.h"

namespace godobject::command {

/// Refuses a scene that this build cannot run: a build for one scene (-DGODOBJECT_SCENE) contains only the parts that
/// its scene needs. Throws Failure (kBadConfig) naming the scene, the missing part and the build option to drop.
void require_in_build(const std::string& scene_name, const SceneView& scene, format::Solver solver, bool friction,
                      const SceneTraits& traits = kSceneTraits);

}  // namespace godobject::command
