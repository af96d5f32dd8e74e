#pragma once

#include <vector>

#include "core/scene/scene_view.h"
#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// A plane of the still surface; the moving body must stay on one side of it. After a body has passed through a thin
/// body its depth is meaningless; the distance behind the barrier is not.
struct Barrier {
  Vector3 point = Vector3::Zero();    ///< in W [m]
  Vector3 normal = Vector3::UnitZ();  ///< unit, in W, towards the allowed side
};

/// Largest distance of the god object behind the barrier, and its time.
struct Crossing {
  double distance = 0.0;  ///< of the farthest sample point, 0 if no point went behind [m]
  double t = 0.0;         ///< [s]
};

/// Returns the crossing over all sample points of the scene and all cycles.
Crossing furthest_crossing(const ReplayLog& log, const SceneView& scene, const Barrier& barrier);

}  // namespace godobject::figures
