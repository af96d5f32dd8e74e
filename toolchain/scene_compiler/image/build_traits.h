#pragma once

#include <string>

#include "core/pipeline/cycle/scene_traits.h"

namespace godobject::scene_compiler {

/// What of the core the image can make use of.
SceneTraits traits_of(const Scene& scene) noexcept;

/// As -DGODOBJECT_SCENE takes them (toolchain/cmake/scene_traits.cmake). `scene_name` is for people.
std::string traits_text(const SceneTraits& traits, const std::string& scene_name);

}  // namespace godobject::scene_compiler
