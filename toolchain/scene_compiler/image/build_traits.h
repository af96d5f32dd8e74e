#pragma once

#include <string>

#include "core/pipeline/cycle/scene_traits.h"

namespace godobject::scene_compiler {

/// Returns the parts of the core that the image uses.
SceneTraits traits_of(const SceneView& scene) noexcept;

/// Returns the traits as the file that -DGODOBJECT_SCENE reads (toolchain/cmake/scene_traits.cmake). `scene_name`
/// appears in a comment.
std::string traits_text(const SceneTraits& traits, const std::string& scene_name);

}  // namespace godobject::scene_compiler
