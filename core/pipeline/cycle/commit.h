#pragma once

#include <algorithm>
#include <cmath>

#include "core/pipeline/cycle/state.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// Ends a cycle of any solver: adds the push of the workspace's faces to `force`, without damping an axis twice, checks
/// that all numbers are finite, and writes `state` and the report's pose and force. `inside`: the god object still
/// penetrates after a start inside. kNotFinite: the pose or the force is NaN or Inf; `state` and `report` are
/// unchanged. Real-time safe.
inline Status commit(const CycleInput& input, const Pose& H_WS, DeviceForce force, bool inside, ProxyState& state,
                     CycleReport& report) noexcept {
  if (input.outside) {
    // contacts may damp along a face's normal already
    const Vector3 damped = force.total_W.force - force.spring_W.force;
    Vector3 damping = input.push.total_W.force - input.push.spring_W.force;
    for (const int axis : {0, 1, 2}) {
      if (damping[axis] * damped[axis] > 0.0) {
        const double left = std::max(0.0, std::fabs(damping[axis]) - std::fabs(damped[axis]));
        damping[axis] = std::copysign(left, damping[axis]);
      }
    }
    force.spring_W.force += input.push.spring_W.force;
    force.total_W.force += input.push.spring_W.force + damping;
  }
  const bool finite = H_WS.is_finite() && force.total_W.force.allFinite() && force.total_W.torque.allFinite() &&
                      force.spring_W.force.allFinite() && force.spring_W.torque.allFinite();
  if (!finite) return Status::kNotFinite;
  state.H_WS = H_WS;
  state.inside = inside;
  state.started = true;
  report.H_WS = H_WS;
  report.force = force;
  report.outside = input.outside;
  return Status::kOk;
}

}  // namespace godobject
