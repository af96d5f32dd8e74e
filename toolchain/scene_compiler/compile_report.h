#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/pipeline/cycle/scene_traits.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/field_check.h"
#include "toolchain/scene_compiler/field/refinement.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/mesh/thin_places.h"
#include "toolchain/scene_compiler/phase_clock.h"
#include "toolchain/scene_compiler/points/ball.h"
#include "toolchain/scene_compiler/points/between_points.h"
#include "toolchain/scene_compiler/points/moving_body.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/scene_compiler/trimming/leaving_out.h"

namespace godobject::scene_compiler {

/// Findings about one mesh.
struct MeshFindings {
  MeshReport report;
  std::vector<SolidSurface::Component> components;
};

/// Findings about the field of the still body, as the image stores it.
struct FieldFindings {
  format::Grid grid{};
  RefinementReport refinement;
  SeamReport seams;
  std::uint64_t brick_positions = 0;  ///< of the whole grid, stored or not
};

/// Findings about the points of the moving body.
struct PointFindings {
  format::Body body{};  ///< as the image stores it
  PointSpread spread;   ///< before trimming
};

/// Findings about contact in the second direction: feature points of the still body in the moving body's field.
struct SecondDirection {
  bool sought = false;             ///< the scene asks for it, and the solver of the image reads it
  BetweenPoints between;           ///< set only if sought
  std::uint32_t added_points = 0;  ///< points of the moving body beyond the requested number
  std::uint32_t corners = 0;       ///< features at sharp vertices of the still body
  std::uint32_t on_edges = 0;      ///< features on its sharp edges and rims
  std::uint32_t on_faces = 0;      ///< features where its faces bend too tightly
  double slack = 0.0;              ///< by which the moving body is smaller in its field [m]
  format::Features features{};     ///< as the image stores them; point_count = 0: the image has no second direction
  format::Grid grid{};             ///< of the moving body's field, as the image stores it
  SeamReport seams;                ///< of that field

  std::uint32_t found() const { return corners + on_edges + on_faces; }  ///< features before trimming
};

/// Most sharp edges of a body that edge against edge takes by default. Chosen: a thread has thousands of sharp edges,
/// which make a cycle slow.
inline constexpr std::uint32_t kMostEdgesByDefault = 1024;

/// Findings about edge against edge: the sharp edges that the image stores.
struct EdgeFindings {
  bool sought = false;  ///< the scene does not switch them off, and the solver of the image reads them
  std::uint32_t still = 0;
  std::uint32_t moving = 0;
  std::uint32_t left_out = 0;  ///< the least sharp ones of bodies with too many
  std::uint32_t too_many = 0;  ///< those of a body that has more than the default takes; then there are none
};

/// Findings of the check, which reads the finished image.
struct CheckFindings {
  FieldError field_error;
  LookUpTime look_up;
  SceneTraits traits;  ///< the parts of the core that a build for this scene alone contains
};

/// The findings of a compilation: everything that the report prints, and no part of the image.
struct CompileReport {
  using SectionSizes = std::vector<std::pair<format::SectionId, std::uint64_t>>;  ///< [bytes]

  SceneConfig config;                         ///< the settings that were compiled
  std::optional<format::Solver> only_solver;  ///< as requested
  nlohmann::ordered_json choice;              ///< as requested
  MeshFindings still;
  MeshFindings moving;
  std::optional<Ball> ball;  ///< set if the moving body is rendered as a ball
  ThinReport thin;           ///< empty for a ball: a body dilated by more than a voxel has no thin places
  FieldFindings field;
  PointFindings points;
  SecondDirection second;
  EdgeFindings edges;
  CheckFindings check;
  std::vector<LeftOut> left_out;
  std::optional<double> cycle_ns;  ///< time of a cycle with nothing left out, if it was measured [ns]
  SectionSizes sections;           ///< without the provenance
  std::uint64_t image_bytes = 0;   ///< known when the image is written
  PhaseClock::Seconds seconds;     ///< of each phase; known when the image is written
};

}  // namespace godobject::scene_compiler
