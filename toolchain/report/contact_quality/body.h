#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// A moving body, sampled by the scene compiler.
struct Body {
  std::filesystem::path file;  ///< its mesh, in metres
  std::uint32_t points = 0;    ///< requested number
  files::SceneImage image;     ///< image of a scene with this body and any still body

  const SceneView& scene() const { return image.scene; }
};

/// Number of levels of every body's sphere tree.
inline constexpr std::uint32_t kBodyLevels = 5;

/// Writes the mesh to `folder`/NAME.ply and compiles it.
Body make_body(const std::string& name, const scene_compiler::TriangleMesh& mesh, std::uint32_t points,
               const std::filesystem::path& folder);

/// Returns the sample points in the body frame B.
std::vector<Vector3> points_B(const SceneView& scene);

}  // namespace godobject::report
