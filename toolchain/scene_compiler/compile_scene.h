#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/pipeline/cycle/scene_traits.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/field_check.h"
#include "toolchain/scene_compiler/field/refinement.h"
#include "toolchain/scene_compiler/image/scene_image.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/thin_places.h"
#include "toolchain/scene_compiler/points/ball.h"
#include "toolchain/scene_compiler/points/between_points.h"
#include "toolchain/scene_compiler/points/moving_body.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/scene_compiler/trimming/leaving_out.h"

namespace godobject::scene_compiler {

/// Name of the phase that refines the field.
inline constexpr const char* kRefinementPhase = "sharp edges";

struct CompileRequest {
  std::filesystem::path scene_file;
  std::optional<SceneConfig> config = {};  ///< taken in place of the file
  std::filesystem::path output;
  std::optional<format::Solver> only_solver;
  nlohmann::ordered_json choice = {};  ///< how the settings were chosen, for the provenance; null: by the scene file
  bool times_left_out = false;         ///< also time what was left out, in some seconds
  std::function<void(const char* phase, double done)> progress;  ///< may be empty
};

/// A mesh as it was taken.
struct MeshFacts {
  MeshReport report;
  std::vector<SolidSurface::Component> components;
};

/// Feature points of the still body against the moving body's field, and what neither direction sees.
struct SecondDirection {
  bool sought = false;             ///< wanted by the scene, and by the solver that the image is for
  BetweenPoints between;           ///< only if sought
  std::uint32_t added_points = 0;  ///< of the moving body, beyond those asked for
  std::uint32_t corners = 0;       ///< features at sharp vertices of the still body
  std::uint32_t on_edges = 0;      ///< on its sharp edges and rims
  std::uint32_t on_faces = 0;      ///< where it bends away too tightly
  double slack = 0.0;              ///< that the moving body's field is of a body smaller by [m]
  format::Features features{};     ///< of the image; point_count = 0: none needed, it holds no second direction
  format::Grid grid{};             ///< of the moving body's field

  std::uint32_t found() const { return corners + on_edges + on_faces; }  ///< features, those left out included
};

/// Everything that the compiler found and measured.
struct CompileReport {
  SceneConfig config;
  std::optional<format::Solver> only_solver;
  nlohmann::ordered_json choice;  ///< that of the request
  MeshFacts still;
  MeshFacts moving;
  std::optional<Ball> ball;  ///< of a scene that has one: no points but its centre, a dilated field
  ThinReport thin;           ///< of a ball's scene nothing is looked for: dilated by more than a voxel nothing is thin
  format::Grid grid{};
  RefinementReport refinement;
  SeamReport seams;
  std::uint64_t brick_positions = 0;
  MovingBody body;  ///< its arrays are moved into the image
  SecondDirection second;
  FieldError field_error;
  LookUpTime look_up;
  std::vector<LeftOut> left_out;
  std::optional<double> cycle_ns;  ///< that a cycle takes where `left_out` was timed, with nothing left out
  SceneTraits traits;              ///< what a build for this image alone would hold
  std::vector<std::pair<format::SectionId, std::uint64_t>> sections;  ///< bytes, provenance left out
  std::uint64_t image_bytes = 0;
  std::vector<std::pair<std::string, double>> seconds;  ///< of each phase
};

/// Reads the scene file and its meshes, builds field and pointshell, measures them, writes the image. Throws Failure.
CompileReport compile_scene(const CompileRequest& request);

}  // namespace godobject::scene_compiler
