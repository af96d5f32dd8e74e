#include "toolchain/report/assembly/pair.h"

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/precision/body_surface.h"
#include "toolchain/report/study/result_file.h"
#include "toolchain/report/work_precision/kept.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::report {
namespace {

/// Of the overlap, over the accuracy. Where parts touch along whole faces, a finer one takes up to a second a cycle.
constexpr double kOverlapTolerance = 0.2;

scene_compiler::SceneConfig config_of(const std::filesystem::path& scene_file) {
  const char* const cure = "name the folder of the scene files with --scenes";
  files::require_regular_input(scene_file, cure);
  scene_compiler::SceneConfig config = scene_compiler::read_scene_config(scene_file);
  files::require_regular_input(config.still.file, cure);
  files::require_regular_input(config.moving.file, cure);
  return config;
}

scene_compiler::TriangleMesh mesh_of(const scene_compiler::SceneConfig::Mesh& mesh) {
  scene_compiler::MeshReport report;
  return scene_compiler::import_mesh(mesh.file, mesh.scale, report);
}

}  // namespace

std::string inputs_of_pair(const std::filesystem::path& scene_file) {
  const scene_compiler::SceneConfig config = config_of(scene_file);
  return fmt::format("scene {} still {} moving {}", file_digest(scene_file), file_digest(config.still.file),
                     file_digest(config.moving.file));
}

std::unique_ptr<Pair> read_pair(const std::filesystem::path& scene_file, const std::filesystem::path& kept) {
  const scene_compiler::SceneConfig config = config_of(scene_file);
  if (!config.accuracy) {
    throw command::Failure(command::ExitCode::kBadConfig,
                           fmt::format("{}: still.accuracy is missing; parts that fit need one, a fifth of their "
                                       "clearance or less",
                                       scene_file.string()));
  }
  return std::make_unique<Pair>(
      Pair{.image = kept_image(kept, inputs_of_pair(scene_file), config),
           .overlap = precision::MeshOverlap(precision::read_surface(config.still, config.thickness),
                                             precision::read_surface(config.moving, config.thickness),
                                             kOverlapTolerance * *config.accuracy),
           .still = mesh_of(config.still),
           .moving = mesh_of(config.moving),
           .accuracy = *config.accuracy});
}

}  // namespace godobject::report
