#pragma once

#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::precision {

/// Reads a body of a scene, in the mesh's frame. Throws Failure (kNoInput, kBadData) if the mesh cannot be used.
scene_compiler::SolidSurface read_surface(const scene_compiler::SceneConfig::Mesh& mesh, double thickness);

}  // namespace godobject::precision
