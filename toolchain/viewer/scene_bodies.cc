#include "toolchain/viewer/scene_bodies.h"

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::viewer {

SceneBodies read_scene_bodies(const std::filesystem::path& scene_file) {
  if (scene_file.extension() == ".scene") {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: a compiled image holds no meshes; give the scene file {}.toml",
                                       scene_file.string(), scene_file.stem().string()));
  }
  const scene_compiler::SceneConfig config = scene_compiler::read_scene_config(scene_file);
  scene_compiler::MeshReport report;
  return {.still = scene_compiler::import_mesh(config.still.file, config.still.scale, report),
          .moving = scene_compiler::import_mesh(config.moving.file, config.moving.scale, report)};
}

}  // namespace godobject::viewer
