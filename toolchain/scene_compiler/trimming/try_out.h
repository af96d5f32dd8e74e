#pragma once

#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "godobject/pose.h"
#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {

/// A short motion for a scene of which nothing is known, as poses of the moving mesh a cycle apart: from several sides,
/// turned at random (fixed seed), the body comes until the scene's own solver says that it touches, is pressed three
/// voxels deep, slides to and fro by ten voxels and leaves. The body's centre starts in the workspace, where there is
/// one. Where nothing is met in that way, it flies by; empty where it has no free place to begin.
std::vector<Pose> try_out_motion(const Scene& scene);

/// The god object's poses of frame B along the motion, by the scene's own solver.
std::vector<Pose> poses_along(const Scene& scene, std::span<const Pose> motion);

/// What a cycle of one scene takes less than that of another, in processor time [ns].
struct Saving {
  double ns = 0.0;           ///< median over the runs; about zero it may be of either sign
  double uncertainty = 0.0;  ///< of the median, one standard error
};

struct CycleTimes {
  double ns = 0.0;              ///< of the first scene: median over the runs of the mean
  std::vector<Saving> savings;  ///< of each scene after the first, over the one before it
};

/// Times each scene's solver along the motion, with friction where the scene has it: runs in turns, of one after the
/// other, for some seconds. `motion` is not empty. Of this machine now.
CycleTimes time_cycles(std::span<const Scene* const> scenes, std::span<const Pose> motion,
                       const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
