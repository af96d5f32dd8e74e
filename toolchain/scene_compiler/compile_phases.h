#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toolchain/scene_compiler/compile_report.h"
#include "toolchain/scene_compiler/image/scene_image.h"
#include "toolchain/scene_compiler/image/scene_parts.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/phase_clock.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/scene_compiler/trimming/unneeded_data.h"

/// The phases of compile_scene, in their order. Each takes const inputs and returns parts of the image, findings for
/// the report, or both. The clock runs them under the names that the report prints. All throw Failure.
namespace godobject::scene_compiler {

/// Name of the phase that refines the still body's field.
inline constexpr const char* kRefinementPhase = "sharp edges";

/// The settings to compile, and the solver that the image is for; empty: all that the settings allow.
struct CompileTarget {
  SceneConfig config;
  std::optional<format::Solver> only_solver;
};

/// Both meshes as bodies.
struct Bodies {
  SolidSurface still;
  SolidSurface moving;
  MeshFindings still_findings;
  MeshFindings moving_findings;
};

/// Imports both meshes and classifies their components.
Bodies read_bodies(const SceneConfig& config, PhaseClock& clock);

/// The body whose field is stored: the still one, for a moving ball dilated by its radius.
struct Obstacle {
  std::optional<Ball> ball;
  std::optional<SolidSurface> dilated;  ///< set for a ball
  ThinReport thin;

  const SolidSurface& surface(const Bodies& bodies) const { return dilated ? *dilated : bodies.still; }
};

/// Measures the ball, or else the thin walls and gaps of the still body. Refuses walls that the field cannot hold.
Obstacle make_obstacle(const SceneConfig& config, const Bodies& bodies, PhaseClock& clock);

struct FieldPhase {
  DistanceGrid field;
  RefinementReport refinement;
};

/// Samples the distances to the obstacle and refines them.
FieldPhase make_field(const SceneConfig& config, const SolidSurface& obstacle, PhaseClock& clock);

struct PointParts {
  MovingBody body;
  StillFeatures features;
  DistanceGrid body_field;   ///< of the moving body; empty without features
  SharpEdgeTree edges;       ///< of the still body; empty if one of the bodies has none
  SharpEdgeTree body_edges;  ///< of the moving body
};

struct PointPhase {
  PointParts parts;
  PointSpread spread;
  SecondDirection second;
  EdgeFindings edges;
};

/// Samples the moving body and, where the target wants them, the features of the still body and the moving body's
/// field. The only point of a ball is its centre.
PointPhase make_points(const CompileTarget& target, const Bodies& bodies, const std::optional<Ball>& ball,
                       PhaseClock& clock);

/// The contents of the image before trimming.
SceneParts join_parts(const CompileTarget& target, DistanceGrid field, PointParts points);

/// Leaves out data that no cycle of the scene reads. `timed` as in TrimmingInput.
Trimmed trim(SceneParts parts, const CompileTarget& target, const Bodies& bodies, const SecondDirection& second,
             bool timed, PhaseClock& clock);

/// Opens the sections as the core does. Measures the field against the exact distances to the obstacle.
CheckFindings check_image(const std::vector<SectionBytes>& sections, const DistanceGrid& field,
                          const SolidSurface& obstacle, const std::string& name, PhaseClock& clock);

}  // namespace godobject::scene_compiler
