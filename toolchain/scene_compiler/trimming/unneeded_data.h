#pragma once

#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/image/scene_parts.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/trimming/leaving_out.h"

namespace godobject::scene_compiler {

/// Leaves out what no cycle of the scene looks at: points that touch nothing, levels of their trees that
/// save nothing, bricks that nothing reaches. `report` and
/// `parts` are complete otherwise. Throws Failure (kBadConfig) naming the cure where from the workspace nothing is
/// touched at all.
void leave_out_unneeded(const SolidSurface& still, const SolidSurface& moving, CompileReport& report, SceneParts& parts,
                        LeavingOut& leaving_out);

}  // namespace godobject::scene_compiler
