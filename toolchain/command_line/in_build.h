#pragma once

#include <string>

#include "core/pipeline/cycle/scene_traits.h"

namespace godobject::command {

/// A build for one scene (-DGODOBJECT_SCENE) runs only what that scene needs. Throws Failure, kBadConfig, naming the
/// scene, what this build is without, and the build option to drop, if the pipeline is not in it.
void require_in_build(const std::string& scene_name, const Scene& scene, format::Solver solver, bool friction,
                      const SceneTraits& traits = kSceneTraits);

}  // namespace godobject::command
