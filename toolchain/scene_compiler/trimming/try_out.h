#pragma once

#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/pose.h"
#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {

/// Returns a short motion for an unknown scene, as poses of the moving mesh, one for each cycle. From several sides and
/// in random orientation (fixed seed) the body approaches until the scene's own solver reports contact. Then it is
/// pressed three voxels deep, slides back and forth by ten voxels and leaves. The body's centre starts in the
/// workspace, if there is one. If the body meets nothing, the motion flies by. Empty if no start is free.
std::vector<Pose> try_out_motion(const SceneView& scene);

/// Returns the god object's poses of frame B along the motion, with the scene's own solver.
std::vector<Pose> poses_along(const SceneView& scene, std::span<const Pose> motion);

/// The processor time by which a cycle of one scene is shorter than that of another [ns].
struct Saving {
  double ns = 0.0;           ///< median over the runs; near zero it may have either sign
  double uncertainty = 0.0;  ///< standard error of the median
};

struct CycleTimes {
  double ns = 0.0;              ///< of the first scene: median over the runs of the mean cycle
  std::vector<Saving> savings;  ///< of each scene after the first against the one before it
};

/// Times each scene's solver along the motion, with friction if the scene has it. Runs take turns, for some seconds.
/// `motion` must not be empty. The result holds for this machine at this time.
CycleTimes time_cycles(std::span<const SceneView* const> scenes, std::span<const Pose> motion,
                       const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
