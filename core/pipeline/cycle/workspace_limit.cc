#include "core/pipeline/cycle/workspace_limit.h"

#include <algorithm>

namespace godobject {

DeviceForce workspace_push(const Vector3& back_W, const Vector3& velocity_W, const Parameters& parameters) noexcept {
  const double stiffness = parameters.stiffness * parameters.coupling_translation;
  const double damping = parameters.damping * parameters.coupling_translation;
  DeviceForce push;
  push.spring_W.force = stiffness * back_W;
  for (int axis = 0; axis < 3; ++axis) {
    if (back_W[axis] == 0.0) continue;
    const double side = back_W[axis] > 0.0 ? 1.0 : -1.0;
    const double size = side * push.spring_W.force[axis] - damping * side * velocity_W[axis];
    push.total_W.force[axis] = side * std::max(0.0, size);
  }
  return push;
}

}  // namespace godobject
