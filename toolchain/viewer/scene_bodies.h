#pragma once

#include <filesystem>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::viewer {

/// The two meshes of a scene in metres: the still one in W, the moving one in its own frame M.
struct SceneBodies {
  scene_compiler::TriangleMesh still;
  scene_compiler::TriangleMesh moving;
};

/// Reads a scene file and imports both of its meshes. Throws Failure as the scene compiler does, and
/// kBadData for a compiled image (X.scene).
SceneBodies read_scene_bodies(const std::filesystem::path& scene_file);

}  // namespace godobject::viewer
