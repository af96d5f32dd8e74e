#pragma once

#include <string>

#include "core/scene/scene_view.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::scene_compiler {

/// Returns how the meshes of a scene file differ, by name or scale, from those that an image was compiled from; empty
/// if they do not, or if the image has no record of them.
std::string difference_of_meshes(const SceneView& scene, const SceneConfig& config);

}  // namespace godobject::scene_compiler
