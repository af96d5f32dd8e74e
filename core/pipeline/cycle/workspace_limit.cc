#include "core/pipeline/cycle/workspace_limit.h"

#include <algorithm>

namespace godobject {

DeviceForce workspace_push(const Vector3& back_W, const Vector3& velocity_W, const Parameters& parameters) noexcept {
  const double stiffness = parameters.stiffness * parameters.coupling_translation;
  const double damping = parameters.damping * parameters.coupling_translation;
  DeviceForce push;
  push.spring_W.force = stiffness * back_W;
  for (const int axis : {0, 1, 2}) {
    const double spring = push.spring_W.force[axis];
    const double damped = spring - damping * velocity_W[axis];
    if (spring * damped > 0.0) push.total_W.force[axis] = damped;  // neither a pull nor a force along the face
  }
  return push;
}

CycleInput input_within(const Pose& H_WD, const Motion& velocity_W, const Parameters& parameters) noexcept {
  CycleInput input;
  input.H_WD = H_WD;
  input.velocity_W = velocity_W;
  if (!parameters.workspace.limited) return input;
  input.H_WD.translation = parameters.workspace.nearest(H_WD.translation);
  input.beyond_W = H_WD.translation - input.H_WD.translation;
  input.outside = !input.beyond_W.isZero(0.0);
  if (!input.outside) return input;
  input.push = workspace_push(-input.beyond_W, velocity_W.translation, parameters);
  const double length = input.beyond_W.stableNorm();
  const double farthest = kFarthestAim * std::max(parameters.mass.radius, parameters.voxel_size);
  if (length > farthest) input.beyond_W *= farthest / length;
  return input;
}

}  // namespace godobject
