#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// A moving body as the scene compiler samples it.
struct Body {
  std::filesystem::path file;  ///< its mesh, in metres
  std::uint32_t points = 0;    ///< asked for
  files::SceneImage image;     ///< of a scene that holds it; its still body does not matter

  const Scene& scene() const { return image.scene; }
};

/// Levels of every body's sphere tree.
inline constexpr std::uint32_t kBodyLevels = 5;

/// Writes the mesh to `folder`/NAME.ply and compiles it.
Body make_body(const std::string& name, const scene_compiler::TriangleMesh& mesh, std::uint32_t points,
               const std::filesystem::path& folder);

/// Sample points in the body frame B.
std::vector<Vector3> points_B(const Scene& scene);

}  // namespace godobject::report
