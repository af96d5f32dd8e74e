#pragma once

#include <optional>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/image/scene_image.h"
#include "toolchain/scene_compiler/points/moving_body.h"
#include "toolchain/scene_compiler/points/sharp_edge_tree.h"
#include "toolchain/scene_compiler/points/still_features.h"

namespace godobject::scene_compiler {

/// The contents of a scene image, without the provenance.
struct SceneParts {
  format::Settings settings{};
  std::optional<format::Workspace> workspace;
  DistanceGrid field;  ///< of the still body
  MovingBody body;
  StillFeatures features;
  DistanceGrid body_field;   ///< of the moving body; stored only with features
  SharpEdgeTree edges;       ///< of the still body, in W; stored only if both bodies have some
  SharpEdgeTree body_edges;  ///< of the moving body, in B
};

/// Returns all sections of the image but the provenance. Stores normals only for the solver `paper`, which reads them.
std::vector<SectionBytes> lay_out(const SceneParts& parts);

}  // namespace godobject::scene_compiler
