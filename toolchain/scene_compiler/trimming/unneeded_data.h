#pragma once

#include <optional>

#include "toolchain/scene_compiler/image/scene_parts.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/trimming/leaving_out.h"
#include "toolchain/scene_compiler/trimming/reachable_bricks.h"

namespace godobject::scene_compiler {

/// Input of the trimming beside the parts of the image.
struct TrimmingInput {
  const SolidSurface& still;
  const SolidSurface& moving;     ///< in its mesh frame M
  bool moving_is_ball;            ///< one point, no features
  std::optional<double> deepest;  ///< largest depth at which the bodies meet between their points [m]; empty: unknown
  bool timed;                     ///< store the images that TrimmingSteps::time compares
};

struct Trimmed {
  SceneParts parts;
  TrimmingSteps steps;
  LeftOutBricks bricks;  ///< left out of the still body's field
};

/// Leaves out the data that no cycle of the scene reads: points that touch nothing, levels of their trees that save no
/// look-up, bricks out of reach of the workspace. Results keep their bits. Throws Failure (kBadConfig) naming the cure
/// if the moving body touches nothing from the whole workspace.
Trimmed leave_out_unneeded(SceneParts parts, const TrimmingInput& input);

}  // namespace godobject::scene_compiler
