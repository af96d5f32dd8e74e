#include "toolchain/figures/crossing.h"

#include <algorithm>

namespace godobject::figures {

Crossing furthest_crossing(const ReplayLog& log, const SceneView& scene, const Barrier& barrier) {
  Crossing furthest;
  for (const ReplayRow& row : log) {
    const Pose H_WB = row.H_WS * scene.H_MB;
    const Vector3 normal_B = H_WB.rotation.conjugate()._transformVector(barrier.normal);
    const double offset = barrier.normal.dot(H_WB.translation - barrier.point);
    double lowest = 0.0;
    for (std::size_t i = 0; i < scene.pointshell.size; ++i)
      lowest = std::min(lowest, offset + normal_B.dot(scene.pointshell.point(i)));
    if (-lowest > furthest.distance) furthest = {-lowest, row.t};
  }
  return furthest;
}

}  // namespace godobject::figures
