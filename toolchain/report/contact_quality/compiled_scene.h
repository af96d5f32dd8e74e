#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/format.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// Parameters that all worlds of the study share. The margin does not depend on the voxel size.
struct WorldSettings {
  double voxel_size = 0.002;       ///< s [m]
  double safety_distance = 0.003;  ///< d [m]
  double margin = 2e-5;            ///< m [m]
  double stiffness = 2000.0;       ///< k_D [N/m]
  double coupling_rotation = 0.025;
  double friction_static = 0.2;
  double friction_kinetic = 0.18;
};

/// A still body for the scene compiler.
struct CompiledStill {
  scene_compiler::TriangleMesh mesh;
  bool shell = false;  ///< thickened to two voxels
};

/// Content of a scene file.
struct SceneText {
  CompiledStill still;
  std::filesystem::path body;  ///< mesh of the moving body, in metres
  bool ball = false;           ///< the moving mesh is a ball, rendered by its centre; no points
  std::uint32_t points = 0;
  bool edges = true;  ///< with edge against edge
  WorldSettings settings = {};
  std::optional<format::Solver> only_solver = {};
};

double shell_thickness(const WorldSettings& settings);

/// Returns the file to which `compile` writes the still body's mesh.
std::filesystem::path still_file(const std::string& name, const std::filesystem::path& folder);

/// Writes mesh and scene file NAME to `folder` and compiles them to NAME.scene.
scene_compiler::CompileReport compile_image(const std::string& name, const SceneText& scene,
                                            const std::filesystem::path& folder);

/// Writes mesh and scene file NAME to `folder`, compiles them and reads the image. An image NAME that is already there
/// is used.
files::SceneImage compile(const std::string& name, const SceneText& scene, const std::filesystem::path& folder);

}  // namespace godobject::report
