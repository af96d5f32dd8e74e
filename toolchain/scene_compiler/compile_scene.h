#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/compile_report.h"
#include "toolchain/scene_compiler/phase_clock.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::scene_compiler {

struct CompileRequest {
  std::filesystem::path scene_file;
  std::optional<SceneConfig> config = {};  ///< replaces the scene file, which must state still.voxel_size
  std::filesystem::path output;
  std::optional<format::Solver> only_solver;
  nlohmann::ordered_json choice = {};  ///< choice of the settings, for the provenance; null: the scene file states them
  bool times_left_out = false;         ///< also measure the time saved by trimming, which takes some seconds
  PhaseProgress progress;
};

/// Reads the scene file and its meshes, builds the fields and points, measures them and writes the image. The image
/// appears under its name only when it is complete. Where the file leaves voxel edges to the compiler, it is compiled
/// with smaller ones until they will do. Deterministic: equal inputs give equal bytes. Throws Failure.
CompileReport compile_scene(const CompileRequest& request);

}  // namespace godobject::scene_compiler
