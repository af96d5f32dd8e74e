#pragma once

#include <vector>

#include "core/scene/scene.h"
#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// A plane of the still surface that the moving body is to stay on one side of. A thin body's depth says nothing once
/// it has been passed; this does.
struct Barrier {
  Vector3 point = Vector3::Zero();    ///< in W [m]
  Vector3 normal = Vector3::UnitZ();  ///< unit, in W, towards where the body may be
};

/// How far the god object went behind the barrier, and when it was furthest.
struct Crossing {
  double distance = 0.0;  ///< of the furthest sample point, 0 if none went behind [m]
  double t = 0.0;         ///< [s]
};

/// Looks at every sample point of the scene in every cycle.
Crossing furthest_crossing(const ReplayLog& log, const Scene& scene, const Barrier& barrier);

}  // namespace godobject::figures
