#pragma once

#include <vector>

#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/image/scene_image.h"
#include "toolchain/scene_compiler/points/still_features.h"

namespace godobject::scene_compiler {

/// What goes into the image beside what a CompileReport holds, provenance left out.
struct SceneParts {
  DistanceGrid field;
  StillFeatures features;
  DistanceGrid body_field;  ///< only with features
};

/// All sections but the provenance.
std::vector<SectionBytes> lay_out(const CompileReport& report, const SceneParts& parts);

}  // namespace godobject::scene_compiler
