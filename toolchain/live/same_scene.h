#pragma once

#include "core/scene/scene_view.h"
#include "toolchain/viewer/scene_bodies.h"

namespace godobject::live {

/// Tells if meshes have the sizes of those that an image was compiled from: the still one fills the box of the stored
/// surface, and the moving one reaches as far as its sample points, to 5 % and, of the box, two voxels.
bool is_same_scene(const viewer::SceneBodies& bodies, const SceneView& scene);

}  // namespace godobject::live
