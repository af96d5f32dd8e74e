#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toolchain/scene_compiler/distance_grid.h"
#include "toolchain/scene_compiler/field_check.h"
#include "toolchain/scene_compiler/mesh_import.h"
#include "toolchain/scene_compiler/moving_body.h"
#include "toolchain/scene_compiler/refinement.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/scene_compiler/scene_image.h"
#include "toolchain/scene_compiler/thin_places.h"

namespace godobject::scene_compiler {

/// Name of the phase that refines the field.
inline constexpr const char* kRefinementPhase = "sharp edges";

struct CompileRequest {
  std::filesystem::path scene_file;
  std::filesystem::path output;
  std::optional<format::Solver> only_solver;
  std::function<void(const char* phase, double done)> progress;  ///< may be empty
};

/// A mesh as it was taken.
struct MeshFacts {
  MeshReport report;
  std::vector<SolidSurface::Component> components;
};

/// Everything that the compiler found and measured.
struct CompileReport {
  SceneConfig config;
  std::optional<format::Solver> only_solver;
  MeshFacts still;
  MeshFacts moving;
  ThinReport thin;
  format::Grid grid{};
  RefinementReport refinement;
  SeamReport seams;
  std::uint64_t brick_positions = 0;
  MovingBody body;  ///< its arrays are moved into the image
  FieldError field_error;
  LookUpTime look_up;
  std::vector<std::pair<format::SectionId, std::uint64_t>> sections;  ///< bytes, provenance left out
  std::uint64_t image_bytes = 0;
  std::vector<std::pair<std::string, double>> seconds;  ///< of each phase
};

/// Reads the scene file and its meshes, builds field and pointshell, measures them, writes the image. Throws Failure.
CompileReport compile_scene(const CompileRequest& request);

}  // namespace godobject::scene_compiler
